#include "engine/geometry/rotation.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/geometry/random_geometry.h"

namespace helical {
namespace {

constexpr int kTrials = 1000;

/// Rotation vectors of every size that matters to the series and the branch cut.
Eigen::Vector3d rotationVector(Random& random, int trial) {
  constexpr double kAngles[] = {0.0, 1e-12, 1e-9, 1e-5, 0.99e-4, 1.01e-4, 0.01, 1.0, 3.0, kPi - 1e-6};
  return randomVector(random, 1.0).normalized() * kAngles[trial % 10];
}

TEST(Rotation, HatIsTheCrossProduct) {
  Random random(1);
  for (int i = 0; i < kTrials; ++i) {
    const Eigen::Vector3d a = randomVector(random, 3.0), b = randomVector(random, 3.0);
    EXPECT_TRUE((hat(a) * b).isApprox(a.cross(b), 1e-14));
  }
}

TEST(Rotation, ExpIsTheRotationAboutTheVectorByItsLength) {
  Random random(2);
  for (int i = 0; i < kTrials; ++i) {
    const Eigen::Vector3d a = rotationVector(random, i);
    const Eigen::Quaterniond q = expSO3(a);
    EXPECT_NEAR(q.norm(), 1.0, 1e-14);
    if (a.norm() == 0.0) continue;
    const Eigen::Matrix3d expected = Eigen::AngleAxisd(a.norm(), a.normalized()).toRotationMatrix();
    EXPECT_TRUE(q.toRotationMatrix().isApprox(expected, 1e-13)) << a.transpose();
  }
}

TEST(Rotation, LogUndoesExp) {
  Random random(3);
  for (int i = 0; i < kTrials; ++i) {
    const Eigen::Vector3d a = rotationVector(random, i);
    EXPECT_LT((logSO3(expSO3(a)) - a).norm(), 1e-9 * a.norm() + 1e-15) << a.transpose();
  }
}

TEST(Rotation, ExpUndoesLogForBothSignsOfTheQuaternion) {
  Random random(4);
  for (int i = 0; i < kTrials; ++i) {
    Eigen::Quaterniond q = randomRotation(random);
    if (i % 2 == 0) q.coeffs() *= -1.0;
    const Eigen::Vector3d a = logSO3(q);
    EXPECT_LE(a.norm(), kPi + 1e-12);
    EXPECT_NEAR(std::abs(expSO3(a).dot(q)), 1.0, 1e-13);
  }
}

TEST(Rotation, HalfTurnsHaveALogarithm) {
  for (const Eigen::Quaterniond& q : {Eigen::Quaterniond(0, 1, 0, 0), Eigen::Quaterniond(0, 0, -0.6, 0.8)})
    EXPECT_NEAR(logSO3(q).norm(), kPi, 1e-12);
}

TEST(Rotation, RightJacobianIsTheDerivativeOfExp) {
  Random random(5);
  for (int i = 0; i < kTrials; ++i) {
    const Eigen::Vector3d a = rotationVector(random, i);
    const auto f = [&](const Eigen::VectorXd& d) -> Eigen::VectorXd {
      return logSO3(expSO3(a).conjugate() * expSO3(a + Eigen::Vector3d(d)));
    };
    const Eigen::MatrixXd numeric = numericJacobian(f, Eigen::Vector3d::Zero(), 1e-5);
    EXPECT_LT((rightJacobianSO3(a) - numeric).norm(), 1e-8) << a.transpose();
  }
}

TEST(Rotation, YawAndTiltAreWhatTheySay) {
  Random random(6);
  for (int i = 0; i < kTrials; ++i) {
    const double yaw = random.uniform(-3.1, 3.1), tilt = random.uniform(0.0, 1.4);
    const Eigen::Quaterniond turn(Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()));
    const Eigen::Quaterniond pitch(Eigen::AngleAxisd(tilt, Eigen::Vector3d::UnitY()));
    EXPECT_NEAR(yawOf(turn * pitch), yaw, 1e-12);
    EXPECT_NEAR(tiltOf(turn * pitch), tilt, 1e-7);
    const Eigen::Quaterniond q = randomRotation(random);
    const Eigen::Vector3d nose = q * Eigen::Vector3d::UnitX(), up = q * Eigen::Vector3d::UnitZ();
    EXPECT_NEAR(yawOf(q), std::atan2(nose.y(), nose.x()), 1e-12);
    EXPECT_NEAR(std::cos(tiltOf(q)), up.z(), 1e-12);
  }
}

TEST(Rotation, WrappedAnglesAreTheSameAngleInOneTurn) {
  Random random(7);
  for (int i = 0; i < kTrials; ++i) {
    const double angle = random.uniform(-50.0, 50.0), wrapped = wrapAngle(angle);
    EXPECT_GE(wrapped, -kPi);
    EXPECT_LT(wrapped, kPi);
    EXPECT_NEAR(std::remainder(angle - wrapped, 2.0 * kPi), 0.0, 1e-12);
  }
  EXPECT_DOUBLE_EQ(wrapAngle(kPi), -kPi);
  EXPECT_DOUBLE_EQ(toDegrees(toRadians(123.0)), 123.0);
}

}  // namespace
}  // namespace helical
