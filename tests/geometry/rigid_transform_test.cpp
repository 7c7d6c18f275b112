#include "engine/geometry/rigid_transform.h"

#include <gtest/gtest.h>

#include "tests/geometry/random_geometry.h"

namespace helical {
namespace {

TEST(RigidTransform, ComposesInvertsAndKeepsDistances) {
  Random random(1);
  for (int i = 0; i < 1000; ++i) {
    const RigidTransform a_from_b = randomTransform(random), b_from_c = randomTransform(random);
    const Eigen::Vector3d p = randomVector(random, 3.0), q = randomVector(random, 3.0);
    EXPECT_LT(((a_from_b * b_from_c) * p - a_from_b * (b_from_c * p)).norm(), 1e-12);
    EXPECT_LT((a_from_b.inverse() * (a_from_b * p) - p).norm(), 1e-12);
    EXPECT_NEAR((a_from_b * p - a_from_b * q).norm(), (p - q).norm(), 1e-12);
    EXPECT_LT((a_from_b * a_from_b.inverseTranslation()).norm(), 1e-12);
    EXPECT_NEAR((a_from_b * b_from_c).rotation.norm(), 1.0, 1e-14);
  }
}

}  // namespace
}  // namespace helical
