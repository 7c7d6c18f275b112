#include "ui/camera_wall.h"

#include <gtest/gtest.h>

#include "ui/camera_pane.h"

namespace helical {
namespace {

RigConfig rigOf(int cameras) {
  RigConfig rig;
  for (int i = 0; i < cameras; ++i) {
    CameraConfig camera;
    camera.name = "Camera " + std::to_string(i + 1);
    camera.model = CameraModel(640, 480, 500.0, 500.0, 319.5, 239.5);
    rig.cameras.push_back(camera);
  }
  return rig;
}

class CameraWallOf : public testing::TestWithParam<int> {};

TEST_P(CameraWallOf, PanesFillTheRoomWithoutOverlap) {
  for (const QSize& size : {QSize(400, 900), QSize(900, 900), QSize(1400, 500)}) {
    CameraWall wall(rigOf(GetParam()));
    wall.resize(size);
    wall.show();
    for (int i = 0; i < wall.count(); ++i) {
      const QRect pane = wall.pane(i).geometry();
      EXPECT_TRUE(wall.rect().contains(pane)) << i;
      EXPECT_GE(pane.width(), 60);
      EXPECT_GE(pane.height(), 60);
      for (int k = 0; k < i; ++k) EXPECT_FALSE(pane.intersects(wall.pane(k).geometry())) << i << " and " << k;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(AnyNumber, CameraWallOf, testing::Values(1, 2, 3, 4, 7, 16));

}  // namespace
}  // namespace helical
