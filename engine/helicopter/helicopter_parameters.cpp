#include "engine/helicopter/helicopter_parameters.h"

#include <algorithm>
#include <cmath>

#include "engine/base/error.h"

namespace helical {
namespace {

void varyRotor(RotorParameters& rotor, double fraction, Random& random) {
  for (double* value : {&rotor.thrust_coefficient, &rotor.drag_coefficient, &rotor.height,
                        &rotor.hinge_stiffness, &rotor.linkage, &rotor.motor_time, &rotor.motor_gain,
                        &rotor.motor_offset, &rotor.phase_slope, &rotor.phase_offset})
    *value *= 1.0 + fraction * random.uniform(-1.0, 1.0);
}

HelicopterParameters drawOnce(HelicopterParameters p, double fraction, Random& random) {
  varyRotor(p.upper, fraction, random);
  varyRotor(p.lower, fraction, random);
  for (double* value :
       {&p.mass, &p.inertia_x, &p.inertia_y, &p.inertia_z, &p.bar_time, &p.lower_tip_path_time,
        &p.swash_plate_range, &p.swash_plate_rate, &p.drag_coefficient, &p.drag_area_x, &p.drag_area_y,
        &p.drag_area_z, &p.lateral_damping, &p.vertical_damping, &p.ground_effect})
    *value *= 1.0 + fraction * random.uniform(-1.0, 1.0);
  p.swash_plate_offset_roll += 0.3 * fraction * random.uniform(-1.0, 1.0);
  p.swash_plate_offset_pitch += 0.3 * fraction * random.uniform(-1.0, 1.0);
  p.thrust_offset_x += 0.01 * fraction * random.uniform(-1.0, 1.0);
  p.thrust_offset_y += 0.01 * fraction * random.uniform(-1.0, 1.0);
  p.maximum_rotor_speed *= 1.0 + fraction * random.uniform(-1.0, 1.0);
  p.rotor_radius *= 1.0 + fraction * random.uniform(-1.0, 1.0);
  return p;
}

bool canHover(const HelicopterParameters& p) {
  const double upper = p.hoverStickUpper(), lower = p.hoverStickLower();
  // With a fifth of the rotor speed to spare: half as much thrust again.
  const bool has_reserve = 1.2 * std::max(p.hoverSpeedUpper(), p.hoverSpeedLower()) < p.maximum_rotor_speed;
  return upper > 0.3 && upper < 0.8 && lower > 0.3 && lower < 0.8 && has_reserve;
}

}  // namespace

HelicopterParameters HelicopterParameters::coax() {
  HelicopterParameters p;
  p.mass = 0.302;
  p.inertia_x = p.inertia_y = 1.837e-3;
  p.inertia_z = 2.779e-4;
  return p;
}

double HelicopterParameters::hoverSpeedUpper() const {
  const double speed_ratio2 = upper.drag_coefficient / lower.drag_coefficient;  // (lower / upper)^2
  return std::sqrt(mass * kGravity / (upper.thrust_coefficient + lower.thrust_coefficient * speed_ratio2));
}

double HelicopterParameters::hoverSpeedLower() const {
  return hoverSpeedUpper() * std::sqrt(upper.drag_coefficient / lower.drag_coefficient);
}

double HelicopterParameters::hoverStickUpper() const {
  return (hoverSpeedUpper() - upper.motor_offset) / upper.motor_gain;
}

double HelicopterParameters::hoverStickLower() const {
  return (hoverSpeedLower() - lower.motor_offset) / lower.motor_gain;
}

HelicopterParameters varied(const HelicopterParameters& nominal, double fraction, Random& random) {
  if (fraction <= 0.0) return nominal;
  for (int attempt = 0; attempt < 1000; ++attempt) {
    const HelicopterParameters p = drawOnce(nominal, fraction, random);
    if (canHover(p)) return p;
  }
  throw Error(ErrorKind::kInput,
              "no helicopter within +-" + std::to_string(fraction) + " of these parameters hovers", {},
              "lower --vary or check [helicopter.parameters]");
}

}  // namespace helical
