// The engine in real time on drawn images. Not under sanitizers: drawing is not what they are for, and takes minutes there.

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
