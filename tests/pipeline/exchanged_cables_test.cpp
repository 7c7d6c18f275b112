// Two cables are exchanged while the helicopter stands before all cameras.

#include <gtest/gtest.h>

#include "engine/config/plan_file.h"
#include "engine/config/resource_files.h"
#include "engine/pipeline/flight_loop.h"
#include "engine/pipeline/rig_hardware.h"
#include "tests/pipeline/flight_fixture.h"

namespace helical {
namespace {

/// Streams count their frames for themselves.
constexpr std::uint64_t kSequenceApart = 5000;

class ExchangedCables : public ::testing::Test {
 protected:
  void stand(int milliseconds) {
    for (const int end = ms_ + milliseconds; ms_ < end; ++ms_) {
      clock_->set(ms_ * kNanosecondsPerMillisecond);
      for (auto& source : hardware_.sources)
        while (source->poll(observation_)) send();
      if (ms_ % 17 == 0) loop_.onTick(clock_->now(), {});
    }
  }
  const CameraSnapshot& camera(std::size_t index) const { return loop_.snapshot().cameras[index]; }

  bool exchanged_ = false;
  FlightLoop& loop() { return loop_; }

 private:
  void send() {
    const int camera = observation_.camera.index();
    const int stream = exchanged_ && camera < 2 ? 1 - camera : camera;
    observation_.camera = cameraId(stream);
    observation_.sequence += static_cast<std::uint64_t>(stream) * kSequenceApart;
    const CameraId taken_for = loop_.cameraOf(observation_.camera);
    loop_.onObservation(observation_, clock_->now());
    EXPECT_EQ(&loop_.lastTrack(),
              &loop_.snapshot().cameras[static_cast<std::size_t>(taken_for.index())].track);
  }

  RigConfig rig_ = test::shippedRig("calibrated", 4);
  std::shared_ptr<ManualClock> clock_ = std::make_shared<ManualClock>();
  RigHardware hardware_ = openRig(rig_, clock_);
  FlightLoop loop_{rig_, loadPlan(planPath("hover"))};
  Observation observation_;
  int ms_ = 1;
};

TEST_F(ExchangedCables, BelongToTheStreamsOfTheOtherCamera) {
  stand(3000);
  ASSERT_TRUE(loop().snapshot().pose_known);
  EXPECT_EQ(loop().snapshot().streams, ownStreams());
  exchanged_ = true;
  stand(1500);
  ASSERT_EQ(loop().snapshot().cables_changed, 1u);
  CameraStreams streams = ownStreams();
  std::swap(streams[0], streams[1]);
  EXPECT_EQ(loop().snapshot().streams, streams);
  for (const std::size_t index : {0, 1}) {
    EXPECT_EQ(loop().cameraOf(streams[index]), cameraId(static_cast<int>(index)));
    EXPECT_EQ(camera(index).track.selected_count, 4) << index;
    EXPECT_LT(camera(index).track.residual_px, 1.0) << index;
  }
  exchanged_ = false;
  stand(1500);
  EXPECT_EQ(loop().snapshot().cables_changed, 2u);
  EXPECT_EQ(loop().snapshot().streams, ownStreams());
}

TEST_F(ExchangedCables, LoseNoFrames) {
  stand(3000);
  exchanged_ = true;
  stand(1500);
  ASSERT_EQ(loop().snapshot().cables_changed, 1u);
  const std::uint64_t dropped = camera(0).dropped + camera(1).dropped;
  stand(3000);
  EXPECT_EQ(camera(0).dropped + camera(1).dropped, dropped);
  EXPECT_EQ(dropped, 0u) << "each stream goes on counting where it was";
  EXPECT_EQ(loop().snapshot().alarms, 0u);
}

}  // namespace
}  // namespace helical
