#include "engine/simulator/simulation_options.h"

#include <cmath>
#include <string>

#include "engine/base/error.h"

namespace helical {
namespace {

void requireRange(double value, double low, double high, const char* key) {
  if (!(value >= low && value <= high))
    throw Error(ErrorKind::kInput, std::string(key) + " is " + std::to_string(value), {},
                "give " + std::to_string(low) + " to " + std::to_string(high));
}

}  // namespace

void validate(const SimulationOptions& o) {
  requireRange(o.gust_factor, 0.0, 10.0, "gust_factor");
  requireRange(o.vary, 0.0, 0.9, "vary");
  requireRange(o.camera_rate_hz, 5.0, 500.0, "camera_rate_hz");
  requireRange(o.rate_error, 0.0, 0.01, "rate_error");
  requireRange(o.readout_delay_s, 0.0, 0.2, "readout_delay_s");
  requireRange(o.field_empty_s, 0.0, 60.0, "field_empty_s");
  requireRange(o.image_noise, 0.0, 50.0, "image_noise");
  requireRange(o.light_drift, 0.0, 0.5, "light_drift");
  requireRange(o.marker_error_m, 0.0, 0.02, "marker_error_m");
  requireRange(o.focal_error, 0.0, 0.1, "focal_error");
  requireRange(o.noise.sigma_px, 0.0, 20.0, "noise.sigma_px");
  requireRange(o.noise.bias_px, 0.0, 20.0, "noise.bias_px");
  requireRange(o.noise.bias_time_s, 0.001, 1000.0, "noise.bias_time_s");
  requireRange(o.noise.dropout, 0.0, 1.0, "noise.dropout");
  requireRange(o.noise.lost_markers, 0.0, 1.0, "noise.lost_markers");
  requireRange(o.noise.false_markers, 0.0, 1.0, "noise.false_markers");
  requireRange(o.noise.outliers, 0.0, 1.0, "noise.outliers");
  for (const auto& occlusion : o.occlusions)
    if (!(occlusion.to_s > occlusion.from_s))
      throw Error(ErrorKind::kInput, "an occlusion ends before it begins", {},
                  "give FROM-TO with FROM below TO");
  for (const auto& bump : o.bumps) {
    requireRange(bump.at_s, 0.0, 1e6, "bump time");
    requireRange(bump.angle, 0.0, 3.15, "bump angle");
    requireRange(bump.distance, 0.0, 5.0, "bump distance");
  }
}

}  // namespace helical
