// Whatever happens to a recording's rows, reading them gives rows that are sound, or an Error with file and cure; nothing
// else, and no crash.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <string>

#include "engine/base/error.h"
#include "engine/base/random.h"
#include "engine/calibration/rig/point_rows.h"

namespace helical {
namespace {

std::string goodRows() {
  std::string text = "time_s,camera,u_px,v_px,marker,body_x_m,body_y_m,body_z_m\n";
  char line[128];
  for (int i = 0; i < 12; ++i) {
    std::snprintf(line, sizeof line, "%.3f,%s,%.2f,%.2f,\"m%d\",%.3f,%.3f,0.01\n", 0.1 * i, i % 2 == 0 ? "1" : "left",
                  100.0 + 7.5 * i, 200.0 - 3.25 * i, i % 4, 0.1 * i, -0.1 * i);
    text += line;
  }
  return text;
}

class DamagedRows : public testing::Test {
 protected:
  DamagedRows() : cameras_(2) {
    cameras_[0].label = "1";
    cameras_[1].label = "left";
    for (RigCamera& camera : cameras_) camera.model = CameraModel(640, 480, 500, 500, 320, 240);
  }
  ~DamagedRows() override { std::remove(path_.c_str()); }

  bool readsOrExplains(const std::string& text) {
    std::ofstream(path_, std::ios::binary) << text;
    try {
      const PointRows rows = readPointRows(path_, cameras_);
      for (const PointRow& row : rows.rows) {
        EXPECT_TRUE(std::isfinite(row.time_s) && row.pixel.allFinite());
        EXPECT_GE(row.camera, 0);
        EXPECT_LT(row.camera, 2);
        EXPECT_GE(row.marker, 0);
        EXPECT_LT(row.marker, static_cast<std::int32_t>(rows.markers.size()));
      }
      EXPECT_TRUE(rows.in_body.empty() || rows.in_body.size() == rows.rows.size());
      for (const auto& point : rows.in_body) EXPECT_TRUE(point.allFinite());
      return true;
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::kInput) << error.what();
      EXPECT_TRUE(error.where().starts_with(path_)) << error.what();
      EXPECT_FALSE(error.cure().empty());
      return false;
    }
  }

  std::string path_ = testing::TempDir() + "damaged_rows.csv";
  std::vector<RigCamera> cameras_;
};

TEST_F(DamagedRows, ReadOrExplainThemselves) {
  const std::string good = goodRows();
  ASSERT_TRUE(readsOrExplains(good));
  for (std::size_t length = 0; length < good.size(); length += 3) readsOrExplains(good.substr(0, length));
  Random random(9);
  const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random.bits() % n); };
  const std::string pieces[] = {",", "\"", "\n", "\r\n", "nan", "inf", "-", "1e999", "1e-999", std::string(1, '\0'), ",,",
                                "\xEF\xBB\xBF", "9999999999999999999999", "left", "0x10"};
  int read = 0, refused = 0;
  for (int i = 0; i < 3000; ++i) {
    std::string text = good;
    for (std::size_t edits = 1 + below(3); edits > 0; --edits) {
      if (random.uniform() < 0.5) text[below(text.size())] = static_cast<char>(random.bits());
      if (random.uniform() < 0.5) text.insert(below(text.size()), pieces[below(std::size(pieces))]);
      if (random.uniform() < 0.3) text.erase(below(text.size()), below(20));
    }
    ++(readsOrExplains(text) ? read : refused);
  }
  EXPECT_GT(read, 100);
  EXPECT_GT(refused, 100);
}

}  // namespace
}  // namespace helical
