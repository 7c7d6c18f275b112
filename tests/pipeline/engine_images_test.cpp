// The engine in real time on drawn images. Not under sanitizers: drawing is not what they are for, and takes
// minutes there.

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <string>
#include <thread>

#include "engine/base/error.h"
#include "engine/config/plan_file.h"
#include "engine/config/resource_files.h"
#include "engine/pipeline/engine.h"
#include "engine/pipeline/first_guess.h"
#include "tests/pipeline/engine_waiting.h"
#include "tests/pipeline/flight_fixture.h"

namespace helical {
namespace {

using namespace std::chrono_literals;

TEST(EngineOnImages, TakesAnotherColourAndANewBackground) {
  RigConfig rig = test::shippedRig("paper", 4);
  rig.simulation.images = true;
  Engine engine(rig, loadPlan(planPath("hover")));
  engine.start();
  const auto seen = [](const auto& now) { return now.cameras[0].centroids >= 4; };
  const auto blind = [](const auto& now) { return now.cameras[0].centroids == 0; };
  ASSERT_TRUE(waitUntil(engine, seen));
  ASSERT_TRUE(engine.pollPicture(cameraId(0)));
  ASSERT_NE(engine.picture(cameraId(0)).background, nullptr);
  EXPECT_EQ(engine.picture(cameraId(0)).background->size(), engine.picture(cameraId(0)).bgr.size());

  ColourRange other = engine.markerColour();
  other.hue_low = (other.hue_low + 90) % 180;
  other.hue_high = (other.hue_high + 90) % 180;
  engine.setMarkerColour(other);
  ASSERT_TRUE(waitUntil(engine, blind)) << "no ball has that colour";
  engine.setMarkerColour(rig.marker_options);
  ASSERT_TRUE(waitUntil(engine, seen));
  other.value_low = 300;
  EXPECT_THROW(engine.setMarkerColour(other), Error);

  engine.takeBackground();
  ASSERT_TRUE(waitUntil(engine, blind));
  ASSERT_TRUE(waitUntil(engine, seen)) << "the helicopter is not part of the background";
}

TEST(EngineOnImages, PicturesAndBoardsAreTheCamerasWhateverCableTheyComeBy) {
  RigConfig rig = test::shippedRig("calibrated", 4);
  rig.simulation.images = true;
  // Cables exchanged before the start: each stands where the other one should.
  rig.simulation.true_camera_from_world = {rig.cameras[1].camera_from_world, rig.cameras[0].camera_from_world,
                                           rig.cameras[2].camera_from_world};
  Engine engine(rig, loadPlan(planPath("hover")));
  WhiteBoards corner;
  corner.count = 1;
  corner.boards[0].count = 4;
  corner.boards[0].corners = {Eigen::Vector2d{0.0, 0.0}, {60.0, 0.0}, {60.0, 60.0}, {0.0, 60.0}};
  engine.setBoards(cameraId(0), corner);
  engine.start();
  ASSERT_TRUE(waitUntil(engine, [](const EngineSnapshot& now) { return now.cables_changed == 1; }));
  const auto white = [&](int camera) {
    const CameraPicture& picture = engine.picture(cameraId(camera));
    const std::size_t at = 3 * static_cast<std::size_t>(30 * picture.width + 30);
    return picture.bgr.size() > at + 3 &&
           std::min({picture.bgr[at], picture.bgr[at + 1], picture.bgr[at + 2]}) > 200;
  };
  ASSERT_TRUE(waitUntil(engine, [&](const EngineSnapshot& now) {
    for (const int camera : {0, 1}) engine.pollPicture(cameraId(camera));
    return now.streams[0] == cameraId(1) && white(0) && !white(1);
  })) << "the board went with its camera";
  engine.setBoards(cameraId(0), {});
  EXPECT_TRUE(waitUntil(engine, [&](const EngineSnapshot&) {
    engine.pollPicture(cameraId(0));
    return !white(0);
  }));
}

TEST(EngineOnImages, PicturesComeWithWhatWasFoundInThem) {
  RigConfig rig = test::shippedRig("paper", 4);
  rig.simulation.images = true;
  Engine engine(rig, loadPlan(planPath("hover")));
  engine.start();
  bool seen = false;
  ASSERT_TRUE(waitUntil(engine, [&](const EngineSnapshot&) {
    for (int c = 0; c < 3; ++c)
      if (engine.pollPicture(cameraId(c)) && engine.picture(cameraId(c)).observation.count == 4) seen = true;
    return seen;
  }));
  const CameraPicture& picture = engine.picture(cameraId(0));
  EXPECT_EQ(picture.width, 640);
  EXPECT_EQ(picture.bgr.size(), 640u * 480u * 3u);
}

}  // namespace
}  // namespace helical
