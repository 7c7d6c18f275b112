#include "engine/config/pose_table.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <cmath>

namespace helical {
namespace {

constexpr double kUnitTolerance = 1e-3;

const char* const kPoseExample = "rotation_wxyz = [1.0, 0.0, 0.0, 0.0] and translation_m = [0.0, 0.0, 3.0]";

}  // namespace

RigidTransform readPose(TomlTable& table) {
  const Eigen::VectorXd identity = Eigen::Vector4d(1, 0, 0, 0), origin = Eigen::Vector3d::Zero();
  const Eigen::VectorXd q =
      table.required("rotation_wxyz", table.numbers("rotation_wxyz", 4), identity, kPoseExample);
  const Eigen::VectorXd t =
      table.required("translation_m", table.numbers("translation_m", 3), origin, kPoseExample);
  table.finish();
  if (!(std::abs(q.norm() - 1.0) <= kUnitTolerance))
    table.fail("rotation_wxyz", "the quaternion is not of length 1", "divide w x y z by their length");
  return {Eigen::Quaterniond(q[0], q[1], q[2], q[3]).normalized(), t};
}

/// The upper limit of 1e6 (a kilometre, squared) keeps sums of them finite.
std::optional<Matrix6d> readCovariance(TomlTable& table) {
  const auto entries = table.numbers("covariance", 36);
  if (!entries) return std::nullopt;
  const Matrix6d covariance = Eigen::Map<const Matrix6d>(entries->data());
  const double largest = covariance.cwiseAbs().maxCoeff();
  const Eigen::SelfAdjointEigenSolver<Matrix6d> eigen(covariance, Eigen::EigenvaluesOnly);
  if (largest > 1e6 || (covariance - covariance.transpose()).cwiseAbs().maxCoeff() > 1e-6 * largest ||
      eigen.eigenvalues().minCoeff() < -1e-6 * largest)
    table.fail("covariance", "'covariance' is no covariance",
               "give the six rows of a symmetric matrix without negative eigenvalues, or leave it out");
  return covariance;
}

}  // namespace helical
