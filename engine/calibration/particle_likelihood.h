#pragma once

#include <Eigen/Core>
#include <span>

#include "engine/calibration/particle_cloud.h"

namespace helical {

/// Where a ball is and where it was seen. Bearings instead of pixels keep the distortion polynomial out of
/// the loop over particles.
struct BearingTarget {
  Eigen::Vector3d ball_in_world;
  Eigen::Vector2d bearing;    ///< of the centroid
  Eigen::Matrix2d whitening;  ///< of a bearing's difference, to standard deviations
  double peak = 0.0;          ///< of the Gaussian: 1 / (sqrt(2 pi) sigma), sigma in pixels
};

/// Equation 11 for every particle, as a logarithm, but for a constant that all of them share. `kPerMarker`: a
/// Gaussian plus the floor for each ball, multiplied: one false centroid then costs every particle the same.
/// `kPerCamera`: as printed, one Gaussian plus the floor over the vector of all pixels. In single precision:
/// 1e-4 pixels.
enum class LikelihoodProduct { kPerMarker, kPerCamera };
void logLikelihoods(const ParticleCloud& cloud, std::span<const BearingTarget> targets, double floor,
                    LikelihoodProduct product, std::span<float> result);

}  // namespace helical
