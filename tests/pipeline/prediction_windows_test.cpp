// Reading images only where the balls are expected, over flights: each frame is read a second time as a
// whole.

#include <gtest/gtest.h>

#include <cstdio>

#include "engine/config/plan_file.h"
#include "engine/config/resource_files.h"
#include "engine/markers/sphere_image.h"
#include "engine/pipeline/flight_loop.h"
#include "engine/pipeline/output_loop.h"
#include "engine/pipeline/rig_hardware.h"
#include "tests/pipeline/flight_fixture.h"

namespace helical {
namespace {

struct Comparison {
  int frames = 0;
  int markers = 0;  ///< that are where a ball is, found by reading everything
  int lost = 0;     ///< of these, by windows
};

class FlightReadTwice {
 public:
  explicit FlightReadTwice(const RigConfig& rig) : rig_(rig) {
    MarkerOptions whole = rig.marker_options;
    whole.whole_every = 1;
    for (std::size_t i = 0; i < rig.cameras.size(); ++i) whole_.emplace_back(whole);
  }

  Comparison fly(int milliseconds) {
    auto clock = std::make_shared<ManualClock>();
    RigHardware hardware = openRig(
        rig_, clock, [this](const Frame& frame, const Observation& windowed, const Extractor&) { readAgain(frame, windowed); });
    world_ = hardware.world;
    FlightLoop loop(rig_, loadPlan(planPath("hover")));
    OutputLoop output(*hardware.transmitter);
    Observation observation;
    for (int ms = 1; ms < milliseconds; ++ms) {
      clock->set(ms * kNanosecondsPerMillisecond);
      for (auto& source : hardware.sources)
        while (source->poll(observation)) loop.onObservation(observation, clock->now());
      if (ms % 17 != 0) continue;
      OperatorCommands commands;
      commands.arm = commands.take_off = ms == 17 * 60;
      output.submit(loop.onTick(clock->now(), commands), clock->now());
      output.step(clock->now());
      for (std::size_t i = 0; i < rig_.cameras.size(); ++i)
        hardware.orders[i]->expect(loop.expectedBalls(cameraId(static_cast<int>(i))));
    }
    return comparison_;
  }

 private:
  void readAgain(const Frame& frame, const Observation& windowed) {
    const auto index = static_cast<std::size_t>(frame.camera.index());
    Observation all;
    all.exposure = frame.exposure;
    whole_[index].extract(frame.image, all);
    moveToBallCentres(rig_.cameras[index].model, all);
    ++comparison_.frames;
    const auto truth = world_->at(frame.exposure);
    if (!truth) return;
    const RigidTransform camera_from_world =
        world_->knocked(frame.camera, trueCameraFromWorld(rig_, frame.camera));
    for (int i = 0; i < all.count; ++i) {
      const Centroid& marker = all.centroids[static_cast<std::size_t>(i)];
      if (!isBall(marker, camera_from_world, truth->state, rig_.cameras[index].model)) continue;
      ++comparison_.markers;
      bool found = false;
      for (int k = 0; k < windowed.count; ++k)
        found = found || windowed.centroids[static_cast<std::size_t>(k)].pixel == marker.pixel;
      comparison_.lost += !found;
    }
  }

  bool isBall(const Centroid& marker, const RigidTransform& camera_from_world, const HelicopterState& state,
              const CameraModel& model) const {
    for (const Eigen::Vector3d& ball : rig_.markers_in_body.all()) {
      const auto pixel = model.project(camera_from_world * (state.world_from_body * ball));
      if (pixel && (*pixel - marker.pixel).norm() < 6.0) return true;
    }
    return false;
  }

  RigConfig rig_;
  std::vector<Extractor> whole_;
  std::shared_ptr<World> world_;
  Comparison comparison_;
};

void expectNothingLost(const char* name, const RigConfig& rig) {
  const Comparison seen = FlightReadTwice(rig).fly(9'000);
  std::printf("%s: %d of %d markers lost in %d frames\n", name, seen.lost, seen.markers, seen.frames);
  EXPECT_GT(seen.markers, 2 * seen.frames);
  EXPECT_EQ(seen.lost, 0);
}

RigConfig renderedRig(std::uint64_t seed) {
  RigConfig rig = test::shippedRig("calibrated", seed);
  rig.simulation.images = true;
  // A background that follows the light away from what was found depends on what else was found.
  rig.marker_options.background_rows = 0;
  return rig;
}

TEST(PredictionWindows, LoseNoMarkerThatAWholeImageShows) {
  RigConfig gusty = renderedRig(3);
  gusty.simulation.gust_factor = 2.0;
  expectNothingLost("gusts", gusty);
  RigConfig knocked = renderedRig(4);
  knocked.simulation.bumps.push_back({cameraId(1), 6.0, 0.03, 0.02});
  test::cover(knocked, {2}, 5.0, 7.0);
  expectNothingLost("a knock and a board", knocked);
}

}  // namespace
}  // namespace helical
