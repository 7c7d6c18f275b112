#include "engine/calibration/calibrator_factory.h"

#include <array>
#include <string>

#include "engine/base/error.h"

namespace helical {
namespace {

constexpr std::array<std::string_view, 6> kNames{"joint", "particle-filter", "growing-gauss-newton",
                                                 "ekf",   "gauss-newton",    "particle-filter-literal"};

}  // namespace

void validate(const CalibratorOptions& options) {
  validate(options.guess);
  validate(options.gauss_newton);
  validate(options.growing_gauss_newton);
  validate(options.particle_filter);
  validate(options.ekf);
  validate(options.joint);
}

std::span<const std::string_view> calibratorNames() {
  return kNames;
}

std::unique_ptr<ExtrinsicCalibrator> makeCalibrator(std::string_view name, const CalibratorOptions& options,
                                                    const CameraModel& camera, const MarkerLayout& markers,
                                                    std::uint64_t seed) {
  validate(options);
  if (name == "joint")
    return std::make_unique<JointCalibrator>(options.joint, options.guess, camera, markers);
  if (name == "ekf") return std::make_unique<EkfCalibrator>(options.ekf, options.guess, camera, markers);
  if (name == "gauss-newton")
    return std::make_unique<FrameGaussNewton>(options.gauss_newton, options.guess, camera, markers);
  if (name == "growing-gauss-newton")
    return std::make_unique<GrowingGaussNewton>(options.growing_gauss_newton, options.guess, camera, markers);
  if (name == "particle-filter")
    return std::make_unique<ParticleFilter>(ParticleFilterKind::kStabilised, options.particle_filter,
                                            options.guess, camera, markers, seed);
  if (name == "particle-filter-literal")
    return std::make_unique<ParticleFilter>(ParticleFilterKind::kLiteral, options.particle_filter,
                                            options.guess, camera, markers, seed);
  std::string known;
  for (const auto& each : kNames) known += (known.empty() ? "" : ", ") + std::string(each);
  throw Error(ErrorKind::kInput, "there is no calibrator \"" + std::string(name) + "\"", {},
              "give one of " + known);
}

}  // namespace helical
