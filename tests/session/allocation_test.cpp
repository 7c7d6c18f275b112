#include <gtest/gtest.h>

#include "engine/pipeline/announcer.h"
#include "engine/session/recorder.h"
#include "tests/session/session_fixture.h"
#include "tests/support/allocation_counter.h"

namespace helical {
namespace {

TEST(Recorder, AllocatesNothingOnTheFlightThread) {
  const test::TemporaryFolder folder;
  Recorder recorder(folder / "a.mcap", test::hoverSettings(1), Recorder::WhenFull::kDrop);
  const auto state = std::make_unique<EngineSnapshot>();
  Observation observation;
  observation.count = kMaxCentroids;
  const CameraTrack track;
  const auto belief = std::make_unique<CalibrationView>();
  belief->count = CalibrationView::kMaxParticles;
  const EngineEvent event = Announcer::event(0, Severity::kInfo, "A gust");
  const long before = test::allocations();
  for (int i = 0; i < 3000; ++i) {
    recorder.onObservation(observation, i, track);
    recorder.onTick({}, *state);
    recorder.onHidden(cameraId(0), i % 2 == 0, i);
    recorder.onCalibration(cameraId(0), "joint", 1, i);
    recorder.onEvent(event);
    recorder.onBelief(cameraId(0), *belief, i);
  }
  EXPECT_EQ(test::allocations(), before);
}

}  // namespace
}  // namespace helical
