#include "engine/calibration/rig/point_rows.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>

#include "engine/base/error.h"

namespace helical {
namespace {

using testing::HasSubstr;

std::vector<RigCamera> twoCameras() {
  std::vector<RigCamera> cameras(2);
  cameras[0].label = "1";
  cameras[1].label = "left";
  for (RigCamera& c : cameras) c.model = CameraModel(640, 480, 500, 500, 320, 240);
  return cameras;
}

class PointRowsTest : public testing::Test {
 protected:
  PointRows read(const std::string& text) {
    std::ofstream(path_, std::ios::binary) << text;
    return readPointRows(path_, cameras_);
  }

  void expectError(const std::string& text, const std::string& what, const std::string& where) {
    try {
      read(text);
      ADD_FAILURE() << "no error for: " << text;
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::kInput);
      EXPECT_THAT(error.problem(), HasSubstr(what));
      EXPECT_THAT(error.where(), HasSubstr(path_ + where));
      EXPECT_FALSE(error.cure().empty());
    }
  }

  void TearDown() override { std::remove(path_.c_str()); }

  std::string path_ = testing::TempDir() + "point_rows_" +
                      testing::UnitTest::GetInstance()->current_test_info()->name() + ".csv";
  std::vector<RigCamera> cameras_ = twoCameras();
};

TEST_F(PointRowsTest, ColumnsInAnyOrder) {
  const PointRows rows = read(
      "\xEF\xBB\xBFv_px, marker ,camera,time_s,u_px,body_y_m,body_x_m,body_z_m\r\n"
      "20,\"a\",left,1e-1, +10.5,2,1,3\r\n\r\n21,b,1,0.2,11,2,1,3");
  ASSERT_EQ(rows.rows.size(), 2U);
  EXPECT_EQ(rows.rows[0].pixel, Eigen::Vector2d(10.5, 20));
  EXPECT_EQ(rows.rows[0].camera, 1);
  EXPECT_EQ(rows.rows[0].time_s, 0.1);
  EXPECT_EQ(rows.markers, (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(rows.rows[1].marker, 1);
  EXPECT_EQ(rows.in_body[0], Eigen::Vector3d(1, 2, 3));
}

TEST_F(PointRowsTest, BadFilesAreRefusedWithTheirLine) {
  expectError("", "is empty", "");
  expectError("time_s,camera,u_px,v_px\n", "no rows", "");
  expectError("0.1,1,10,20\n", "no header", ":1");
  expectError("time_s;camera;u_px;v_px\n", "semicolons", ":1");
  expectError("time_s,camera,u_px\n", "'v_px' is missing", ":1");
  expectError("time_s,camera,u_px,v_px,u_px\n", "twice", ":1");
  expectError("time_s,camera,u_px,v_px,colour\n", "unknown column 'colour'", ":1");
  expectError("time_s,camera,u_px,v_px,body_x_m\n", "not all there", ":1");
  const std::string header = "time_s,camera,u_px,v_px\n0,1,10,20\n";
  expectError(header + "0,1,nan,20\n", "not finite", ":3");
  expectError(header + "0,1,10,inf\n", "not finite", ":3");
  expectError(header + "0,1,10,20px\n", "no number", ":3");
  expectError(header + "0,1,10\n", "3 fields", ":3");
  expectError(header + "0,1,10,20,30\n", "5 fields", ":3");
  expectError(header + "0,2,10,20\n", "no camera '2'", ":3");
  expectError(header + "1,0,10,20\n", "no camera '0'", ":3");
  expectError("time_s,camera,u_px,v_px,marker\n0,1,1,1,\n", "no name", ":2");
  expectError(std::string("time_s,camera,u_px,v_px\n0,1,\0,2\n", 32), "no number", ":2");
}

TEST_F(PointRowsTest, SwappedColumnsAreFound) {
  std::string uv = "time_s,camera,v_px,u_px\n", time = "u_px,camera,time_s,v_px\n",
              wide = "time_s,camera,u_px,v_px\n";
  for (int i = 0; i < 200; ++i) {
    const std::string u = std::to_string(10 + (i * 37) % 620), v = std::to_string(20 + (i * 53) % 440);
    uv += std::to_string(i) + ",1," + u + "," + v + "\n";
    time += std::to_string(i) + ",1," + u + "," + v + "\n";
    wide += std::to_string(i) + ",1," + std::to_string(700 + i) + "," + v + "\n";
  }
  expectError(uv, "u_px and v_px look swapped", "");
  expectError(time, "time_s and u_px look swapped", "");
  expectError(wide, "lie outside", "");
}

}  // namespace
}  // namespace helical
