#include "engine/calibration/rig/rig_frame.h"

#include <Eigen/Eigenvalues>
#include <algorithm>

#include "engine/geometry/rotation.h"

namespace helical {
namespace {

struct Correspondence {
  RigidTransform solved, given;  // camera_from_world, of either world
};

std::vector<Correspondence> correspondences(const RigState& state, std::span<const RigCamera> cameras) {
  std::vector<Correspondence> found;
  for (std::size_t c = 0; c < cameras.size(); ++c)
    if (state.camera_from_world[c] && cameras[c].camera_from_world)
      found.push_back({*state.camera_from_world[c], *cameras[c].camera_from_world});
  if (!found.empty()) return found;
  for (const auto& pose : state.camera_from_world)
    if (pose) return {{*pose, RigidTransform{}}};
  return {};
}

Eigen::Vector3d mean(std::span<const Correspondence> all, RigidTransform Correspondence::*which) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Correspondence& c : all) sum += (c.*which).inverseTranslation();
  return sum / static_cast<double>(all.size());
}

double spread(std::span<const Correspondence> all, RigidTransform Correspondence::*which) {
  const Eigen::Vector3d centre = mean(all, which);
  double sum = 0.0;
  for (const Correspondence& c : all) sum += ((c.*which).inverseTranslation() - centre).norm();
  return sum;
}

/// Mean of the rotations that each camera suggests (largest eigenvector of the sum of q q^T).
Eigen::Quaterniond meanRotation(std::span<const Correspondence> all) {
  Eigen::Matrix4d sum = Eigen::Matrix4d::Zero();
  for (const Correspondence& c : all) {
    const Eigen::Vector4d q = (c.given.rotation.conjugate() * c.solved.rotation).coeffs();
    sum += q * q.transpose();
  }
  const Eigen::Vector4d q = Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d>(sum).eigenvectors().col(3);
  return Eigen::Quaterniond(q[3], q[0], q[1], q[2]).normalized();
}

}  // namespace

GivenPoseError alignToGiven(RigState& state, std::span<const RigCamera> cameras, bool metric_already,
                            const std::optional<KnownDistance>& scale) {
  auto pairs = correspondences(state, cameras);
  GivenPoseError error;
  if (pairs.empty()) return error;
  double factor = 1.0;
  if (scale && state.camera_from_world[scale->a] && state.camera_from_world[scale->b]) {
    const double solved = (state.camera_from_world[scale->a]->inverseTranslation() -
                           state.camera_from_world[scale->b]->inverseTranslation())
                              .norm();
    if (solved > 1e-9) factor = scale->metres / solved;
  } else if (!metric_already && pairs.size() > 1) {
    const double solved = spread(pairs, &Correspondence::solved);
    if (solved > 1e-9) factor = spread(pairs, &Correspondence::given) / solved;
  }
  moveWorld(state, RigidTransform{}, factor);
  pairs = correspondences(state, cameras);
  RigidTransform new_from_old;
  new_from_old.rotation = meanRotation(pairs);
  new_from_old.translation =
      mean(pairs, &Correspondence::given) - new_from_old.rotation * mean(pairs, &Correspondence::solved);
  moveWorld(state, new_from_old, 1.0);
  for (const Correspondence& c : correspondences(state, cameras)) {
    if (std::none_of(cameras.begin(), cameras.end(),
                     [](const auto& k) { return k.camera_from_world.has_value(); }))
      break;
    error.degrees = std::max(error.degrees, toDegrees(c.given.rotation.angularDistance(c.solved.rotation)));
    error.metres =
        std::max(error.metres, (c.given.inverseTranslation() - c.solved.inverseTranslation()).norm());
  }
  return error;
}

void fixGiven(RigState& state, std::span<const RigCamera> cameras) {
  for (std::size_t c = 0; c < cameras.size(); ++c) {
    if (!cameras[c].camera_from_world) continue;
    state.camera_from_world[c] = cameras[c].camera_from_world;
    state.fixed[c] = true;
  }
}

}  // namespace helical
