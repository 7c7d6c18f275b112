// Whatever happens to a file, loading it gives a rig, plan or calibration, or an Error; nothing else, and no crash.

#include <gtest/gtest.h>

#include <string>

#include "engine/base/random.h"
#include "engine/config/calibration_file.h"
#include "engine/config/plan_file.h"
#include "engine/config/resource_files.h"
#include "engine/config/rig_file.h"
#include "engine/config/text_file.h"
#include "tests/config/rig_text.h"

namespace helical {
namespace {

template <class Parse>
bool loadsOrExplains(const std::string& text, Parse parse) {
  try {
    parse(text, "damaged.toml");
    return true;
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kInput);
    EXPECT_TRUE(error.where().starts_with("damaged.toml:")) << error.what();
    EXPECT_FALSE(error.problem().empty());
    EXPECT_FALSE(error.cure().empty());
    return false;
  }
}

template <class Parse>
void damage(const std::string& good, Parse parse) {
  ASSERT_TRUE(loadsOrExplains(good, parse));
  for (std::size_t length = 0; length < good.size(); ++length) loadsOrExplains(good.substr(0, length), parse);
  Random random(5);
  const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random.bits() % n); };
  for (int i = 0; i < 4000; ++i) {
    std::string text = good;
    text[below(text.size())] = static_cast<char>(random.bits());
    loadsOrExplains(text, parse);
  }
  for (int i = 0; i < 1000; ++i) {
    std::string text = good;
    const std::size_t from = below(text.size()), to = below(text.size());
    text.insert(to, good.substr(from, below(40)));
    text.erase(below(text.size()), below(10));
    loadsOrExplains(text, parse);
  }
}

TEST(DamagedFile, OfARigLoadsOrExplainsItself) {
  damage(readTextFile(resourceFolder() / "rigs" / "paper.toml", "rig file"), parseRig);
  damage(goodRig(), parseRig);
}

TEST(DamagedFile, OfAPlanLoadsOrExplainsItself) {
  damage(readTextFile(resourceFolder() / "plans" / "waypoints.toml", "flight plan"), parsePlan);
}

TEST(DamagedFile, OfATransmittersChannelsLoadsOrExplainsItself) {
  std::string text = goodRig() + "\n[transmitter]\nkind = \"mcc-usb-3100\"\ntrainer_input = 2\nrate_hz = 200\n";
  for (const char* stick : {"throttle", "yaw", "roll", "pitch"})
    text += "[[transmitter.channel]]\nstick = \"" + std::string(stick) + "\"\nminimum = 0.5\nneutral = 2.0\nmaximum = 4.5\n";
  damage(text, parseRig);
}

TEST(DamagedFile, OfACalibrationLoadsOrExplainsItself) {
  SavedCalibration calibration;
  calibration.rig = "rig.toml";
  calibration.written = "2010-12-21T10:00:00Z";
  SavedCamera camera;
  camera.label = "left";
  camera.method = "joint";
  camera.camera_from_world.translation = {0.25, -2.0, 1.5};
  camera.covariance = 1e-6 * Matrix6d::Identity();
  calibration.cameras.assign(2, camera);
  calibration.cameras[1].label = "right";
  damage(toToml(calibration), parseCalibration);
}

TEST(DamagedFile, NestedWithoutEndIsRefused) {
  EXPECT_FALSE(loadsOrExplains("a = " + std::string(100'000, '['), parseRig));
  EXPECT_FALSE(loadsOrExplains(std::string(100'000, '['), parseRig));
  std::string braces = "a = ";
  for (int i = 0; i < 50'000; ++i) braces += "{a=";
  EXPECT_FALSE(loadsOrExplains(braces, parseRig));
}

}  // namespace
}  // namespace helical
