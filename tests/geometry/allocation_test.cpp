#include <gtest/gtest.h>

#include <vector>

#include "engine/base/random.h"
#include "engine/geometry/camera_resection.h"
#include "engine/geometry/rotation.h"
#include "tests/support/allocation_counter.h"

namespace helical {
namespace {

TEST(CameraResectionAllocation, NoneByOurOwnSolvers) {
  Random random(1);
  const CameraModel camera(640, 480, 567.6, 567.6, 319.5, 239.5, {-0.05, 0.01, 0.0004, -0.0003, 0.0});
  const RigidTransform camera_from_world{expSO3({toRadians(-130.0), 0, 0}), {0.1, 0.0, 2.5}};
  std::vector<WorldPoint> points;
  for (int i = 0; i < 40; ++i) {
    const Eigen::Vector3d in_world(random.uniform(-0.3, 0.3), random.uniform(-0.3, 0.3),
                                   random.uniform(-0.3, 0.3));
    points.push_back({in_world, *camera.project(camera_from_world * in_world)});
  }
  RigidTransform guess = camera_from_world;
  guess.translation.x() += 0.05;
  for (const auto method : {ResectionMethod::kGaussNewton, ResectionMethod::kLevenbergMarquardt}) {
    ResectionOptions options;
    options.method = method;
    options.robust_scale_px = 50.0;
    const long before = test::allocations();
    const Resection found = resectCamera(camera, points, guess, options);
    EXPECT_EQ(test::allocations(), before);
    EXPECT_EQ(found.status, ResectionStatus::kConverged);
  }
}

}  // namespace
}  // namespace helical
