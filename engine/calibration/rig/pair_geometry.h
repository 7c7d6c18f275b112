#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>

#include "engine/geometry/rigid_transform.h"

namespace helical {

/// How two cameras stand to each other by their bearings (x/z, y/z) of the same points.
struct PairGeometry {
  RigidTransform b_from_a;    ///< of arbitrary scale: the translation has length 1
  int inliers = 0;            ///< in front of both cameras and near their epipolar lines
  double parallax_deg = 0.0;  ///< median over the inliers
};

constexpr int kPairSamples = 5000;

/// Five-point essential matrix (Nister 2004) by random samples, and the pose among its four that puts points
/// before both cameras. `tolerance` is of bearings. Nothing from fewer than 12 points, or inliers. Repeats
/// bit for bit.
std::optional<PairGeometry> relatePair(std::span<const Eigen::Vector2d> bearings_a,
                                       std::span<const Eigen::Vector2d> bearings_b, double tolerance,
                                       int samples = kPairSamples);

/// Camera pose from points in the world and bearings by random samples of three (P3P), refined on the
/// inliers.
struct PointResection {
  RigidTransform camera_from_world;
  int inliers = 0;
};
std::optional<PointResection> resectByPoints(std::span<const Eigen::Vector3d> in_world,
                                             std::span<const Eigen::Vector2d> bearings, double tolerance);

}  // namespace helical
