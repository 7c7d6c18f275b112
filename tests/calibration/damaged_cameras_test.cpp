// Whatever happens to another program's camera file, reading it gives cameras that are sound, or an Error with file and
// cure; nothing else, and no crash.

#include <gtest/gtest.h>

#include <string>

#include "engine/base/error.h"
#include "engine/base/random.h"
#include "engine/calibration/intrinsics/camera_exchange.h"

namespace helical {
namespace {

bool readsOrExplainsCameras(const std::string& text) {
  try {
    const auto cameras = readCameras(text, "damaged.yaml", std::nullopt);
    EXPECT_FALSE(cameras.empty());
    for (const ExchangedCamera& camera : cameras) {
      EXPECT_GT(camera.model.width(), 0);
      EXPECT_GT(camera.model.fx(), 0.0);
      if (camera.camera_from_world) {
        EXPECT_TRUE(camera.camera_from_world->translation.allFinite());
      }
    }
    return true;
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kInput) << error.what();
    EXPECT_TRUE(error.where().starts_with("damaged.yaml")) << error.what();
    EXPECT_FALSE(error.cure().empty()) << error.what();
    return false;
  }
}

std::string goodCameras(CameraFormat format) {
  ExchangedCamera camera{"left", CameraModel(640, 480, 567.6, 566.2, 319.5, 239.5, {-0.05, 0.01, 4e-4, -3e-4, 0.0}), {}};
  std::vector<ExchangedCamera> cameras{camera};
  if (format == CameraFormat::kKalibr) {
    cameras[0].camera_from_world = RigidTransform{};
    cameras.push_back(cameras[0]);
    cameras[1].label = "right";
    cameras[1].camera_from_world->translation.x() = 0.4;
  }
  return writeCameras(cameras, format);
}

TEST(DamagedCameras, ReadOrExplainThemselves) {
  for (const CameraFormat format : {CameraFormat::kOpenCv, CameraFormat::kKalibr, CameraFormat::kRos}) {
    const std::string good = goodCameras(format);
    ASSERT_TRUE(readsOrExplainsCameras(good)) << good;
    for (std::size_t length = 0; length < good.size(); ++length) readsOrExplainsCameras(good.substr(0, length));
    Random random(7);
    const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random.bits() % n); };
    for (int i = 0; i < 4000; ++i) {
      std::string text = good;
      for (std::size_t n = 1 + below(3); n > 0; --n) text[below(text.size())] = static_cast<char>(random.bits());
      if (i % 4 == 0) text.insert(below(text.size()), good.substr(below(good.size()), below(40)));
      if (i % 4 == 1) text.erase(below(text.size()), below(20));
      readsOrExplainsCameras(text);
    }
  }
}

TEST(DamagedCameras, NestedWithoutEndAreRefused) {
  for (const char* opening : {"[", "{a: ", "- "})
    for (const int depth : {10, 1000, 100'000}) {
      std::string text = "cam0: ";
      for (int i = 0; i < depth; ++i) text += opening;
      EXPECT_FALSE(readsOrExplainsCameras(text)) << depth << " times " << opening;
    }
}

}  // namespace
}  // namespace helical
