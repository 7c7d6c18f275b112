#include "engine/pipeline/calibration_view.h"

#include <algorithm>

namespace helical {

void fillView(const CameraCalibration& calibration, CalibrationView& view) {
  const auto particles = calibration.calibrator().particles();
  view.total = static_cast<int>(particles.size());
  view.count = 0;
  if (particles.empty()) return;
  const std::size_t step =
      (particles.size() + CalibrationView::kMaxParticles - 1) / CalibrationView::kMaxParticles;
  float heaviest = 0.0F;
  for (std::size_t i = 0; i < particles.size(); i += step) {
    CalibrationView::Particle& particle = view.particles[static_cast<std::size_t>(view.count++)];
    particle.centre_in_world = particles[i].camera_from_world.inverseTranslation().cast<float>();
    particle.weight = static_cast<float>(particles[i].weight);
    heaviest = std::max(heaviest, particle.weight);
  }
  if (heaviest <= 0.0F) return;
  for (int i = 0; i < view.count; ++i) view.particles[static_cast<std::size_t>(i)].weight /= heaviest;
}

}  // namespace helical
