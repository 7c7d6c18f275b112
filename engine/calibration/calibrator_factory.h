#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string_view>

#include "engine/calibration/ekf_calibrator.h"
#include "engine/calibration/extrinsic_calibrator.h"
#include "engine/calibration/frame_gauss_newton.h"
#include "engine/calibration/growing_gauss_newton.h"
#include "engine/calibration/joint_calibrator.h"
#include "engine/calibration/particle_filter.h"

namespace helical {

/// Settings of all methods.
struct CalibratorOptions {
  GuessSpread guess;
  FrameGaussNewtonOptions gauss_newton;
  GrowingGaussNewtonOptions growing_gauss_newton;
  ParticleFilterOptions particle_filter;
  EkfOptions ekf;
  JointOptions joint;
};

/// Throws Error(kInput) naming the offending key.
void validate(const CalibratorOptions& options);

/// Names that `makeCalibrator` knows, in the order users are shown.
std::span<const std::string_view> calibratorNames();

/// A calibrator for one camera. Throws Error(kInput), listing the known names, for another one. `seed` should
/// differ from camera to camera; methods without random numbers ignore it.
std::unique_ptr<ExtrinsicCalibrator> makeCalibrator(std::string_view name, const CalibratorOptions& options,
                                                    const CameraModel& camera, const MarkerLayout& markers,
                                                    std::uint64_t seed);

}  // namespace helical
