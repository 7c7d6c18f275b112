#include "ui/status_words.h"

#include <gtest/gtest.h>

#include "ui/theme.h"

namespace helical {
namespace {

EngineSnapshot snapshotOf(FlightPhase phase, SafetyState safety, bool pose_known) {
  EngineSnapshot snapshot;
  snapshot.phase = phase;
  snapshot.safety = safety;
  snapshot.pose_known = pose_known;
  return snapshot;
}

TEST(StatusWords, ReadinessSaysWhatMattersMost) {
  const auto word = [](FlightPhase phase, SafetyState safety, bool pose) {
    return readinessWord(snapshotOf(phase, safety, pose)).text;
  };
  EXPECT_EQ(word(FlightPhase::kIdle, SafetyState::kNormal, false), "No pose");
  EXPECT_EQ(word(FlightPhase::kIdle, SafetyState::kNormal, true), "Ready");
  EXPECT_EQ(word(FlightPhase::kFlying, SafetyState::kNormal, true), "Flying");
  EXPECT_EQ(word(FlightPhase::kFlying, SafetyState::kCoasting, false), "Coasting");
  EXPECT_EQ(word(FlightPhase::kLanding, SafetyState::kLandNow, true), "Land now");
  EXPECT_EQ(word(FlightPhase::kOff, SafetyState::kLandNow, true), "Landed");
  EXPECT_EQ(word(FlightPhase::kOff, SafetyState::kCut, true), "Cut");
}

TEST(StatusWords, WhoFliesIsThePilotWhoHasTakenOverWhateverTheEngineDoes) {
  EngineSnapshot snapshot = snapshotOf(FlightPhase::kIdle, SafetyState::kNormal, true);
  EXPECT_EQ(pilotWord(snapshot).text, "Nobody");
  snapshot.armed = true;
  EXPECT_EQ(pilotWord(snapshot).text, "Helical");
  snapshot.phase = FlightPhase::kFlying;
  EXPECT_EQ(pilotWord(snapshot).text, "Helical");
  snapshot.devices.transmitter.pilot_flies = true;
  EXPECT_EQ(pilotWord(snapshot).text, "Pilot");
  EXPECT_EQ(pilotWord(snapshot).color, theme::kCaution);
  snapshot.devices.transmitter.pilot_flies = false;
  snapshot.safety = SafetyState::kCut;
  EXPECT_EQ(pilotWord(snapshot).text, "Nobody");
}

TEST(StatusWords, NotReadyWhileTheAutopilotWouldRefuse) {
  EngineSnapshot snapshot = snapshotOf(FlightPhase::kIdle, SafetyState::kNormal, true);
  snapshot.obstacle = "it moves";
  EXPECT_EQ(readinessWord(snapshot).text, "Not ready");
}

TEST(StatusWords, ReadyMeansThatItCouldBeArmed) {
  EngineSnapshot snapshot = snapshotOf(FlightPhase::kIdle, SafetyState::kNormal, true);
  snapshot.failing_checks = static_cast<std::uint32_t>(PreArmCheck::kFrameRate);
  EXPECT_EQ(readinessWord(snapshot).text, "Not ready");
  snapshot.failing_checks = 0;
  snapshot.armed = true;
  EXPECT_EQ(readinessWord(snapshot).text, "Armed");
}

TEST(StatusWords, RedIsDangerAndNothingElse) {
  for (int phase = 0; phase <= static_cast<int>(FlightPhase::kOff); ++phase)
    for (int safety = 0; safety <= static_cast<int>(SafetyState::kCut); ++safety) {
      const auto state = static_cast<SafetyState>(safety);
      const bool danger =
          state == SafetyState::kCut ||
          (state == SafetyState::kDescending && static_cast<FlightPhase>(phase) != FlightPhase::kOff);
      const StatusWord word = readinessWord(snapshotOf(static_cast<FlightPhase>(phase), state, true));
      EXPECT_EQ(word.color == theme::kDanger, danger) << word.text.toStdString();
      EXPECT_FALSE(word.text.isEmpty());
    }
}

TEST(StatusWords, FailsafesAreListedByName) {
  EXPECT_EQ(failsafeNames(0), "");
  EXPECT_EQ(failsafeNames(static_cast<std::uint32_t>(Failsafe::kFence) |
                          static_cast<std::uint32_t>(Failsafe::kKill)),
            "fence, stop");
}

TEST(StatusWords, ACameraCountsAsTrackedOnlyWhileItHelps) {
  EngineSnapshot snapshot;
  snapshot.time = kNanosecondsPerSecond;
  snapshot.camera_count = 3;
  for (auto& camera : snapshot.cameras) camera.track.exposure = snapshot.time;
  snapshot.cameras[0].track.selected_count = 4;
  snapshot.cameras[1].track.selected_count = 4;
  snapshot.cameras[1].track.exposure = snapshot.time / 2;
  EXPECT_EQ(trackedCameras(snapshot), 1);
}

TEST(StatusWords, ACameraThatNobodyTeachesSaysSo) {
  EngineSnapshot snapshot;
  snapshot.time = kNanosecondsPerSecond;
  snapshot.camera_count = 3;
  for (auto& camera : snapshot.cameras) camera.track.exposure = snapshot.time;
  snapshot.cameras[0].track.selected_count = snapshot.cameras[1].track.selected_count = 4;
  snapshot.cameras[2].estimate.status = CameraStatus::kCalibrating;
  EXPECT_EQ(calibrationWord(snapshot, 2).text, "Converging");
  snapshot.cameras[2].estimate.status = CameraStatus::kRejected;
  EXPECT_EQ(calibrationWord(snapshot, 2).text, "Knocked");
  snapshot.cameras[2].estimate.status = CameraStatus::kUncalibrated;
  EXPECT_EQ(calibrationWord(snapshot, 2).text, "Searching labels");
  snapshot.cameras[1].track.selected_count = 0;
  EXPECT_EQ(calibrationWord(snapshot, 2).text, "Needs two others");
  snapshot.cameras[2].hidden = true;
  EXPECT_EQ(calibrationWord(snapshot, 2).text, "Hidden");
  snapshot.cameras[2].hidden = false;
  snapshot.cameras[2].estimate.status = CameraStatus::kCalibrated;
  EXPECT_EQ(calibrationWord(snapshot, 2).text, "Calibrated");
}

TEST(StatusWords, NoReferenceOnceTheRotorsAreCut) {
  EXPECT_TRUE(hasReference(snapshotOf(FlightPhase::kFlying, SafetyState::kNormal, true)));
  EXPECT_FALSE(hasReference(snapshotOf(FlightPhase::kFlying, SafetyState::kCut, true)));
  EXPECT_FALSE(hasReference(snapshotOf(FlightPhase::kIdle, SafetyState::kNormal, true)));
}

}  // namespace
}  // namespace helical
