#include "ui/coverage.h"

#include <gtest/gtest.h>

#include <cmath>

namespace helical {
namespace {

/// Straight above (x, y), looking down: at the floor it sees 3.2 m by 2.4 m.
RigidTransform above(double x, double y) {
  RigidTransform world_from_camera;
  world_from_camera.rotation = Eigen::AngleAxisd(std::acos(-1.0), Eigen::Vector3d::UnitX());
  world_from_camera.translation = {x, y, 2.5};
  return world_from_camera.inverse();
}

class Coverage : public testing::Test {
 protected:
  const CameraModel model_{640, 480, 500.0, 500.0, 319.5, 239.5};
};

TEST_F(Coverage, OneCameraAloneCoversNothing) {
  EXPECT_TRUE(coverageContours({{&model_, above(0, 0)}}, {0.0}, 3.0).empty());
}

TEST_F(Coverage, TheBorderIsThatOfTheOverlap) {
  const auto lines = coverageContours({{&model_, above(-0.5, 0)}, {&model_, above(0.5, 0)}}, {0.0}, 3.0);
  ASSERT_GT(lines.size(), 20U);
  for (const Eigen::Vector3d& point : lines) {
    const double to_side = std::abs(std::abs(point.x()) - 1.1);
    const double to_end = std::abs(std::abs(point.y()) - 1.2);
    // Corners of the overlap are cut by up to a cell.
    EXPECT_LT(std::min(to_side, to_end), 0.08) << point.transpose();
    EXPECT_LT(std::abs(point.x()), 1.2);
    EXPECT_LT(std::abs(point.y()), 1.3);
    EXPECT_EQ(point.z(), 0.0);
  }
}

TEST_F(Coverage, AThirdCameraWidensItAndHeightNarrowsIt) {
  const auto widest = [&](const std::vector<CoveringCamera>& cameras, double height) {
    double x = 0.0;
    for (const Eigen::Vector3d& point : coverageContours(cameras, {height}, 4.0)) x = std::max(x, point.x());
    return x;
  };
  const std::vector<CoveringCamera> two{{&model_, above(-0.5, 0)}, {&model_, above(0.5, 0)}};
  std::vector<CoveringCamera> three = two;
  three.push_back({&model_, above(1.0, 0)});
  EXPECT_GT(widest(three, 0.0), widest(two, 0.0) + 0.5);
  EXPECT_LT(widest(two, 1.0), widest(two, 0.0) - 0.3);
}

}  // namespace
}  // namespace helical
