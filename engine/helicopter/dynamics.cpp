#include "engine/helicopter/dynamics.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "engine/geometry/rotation.h"

namespace helical {
namespace {

constexpr double kAirDensity = 1.2;

// Skids: an assumption of 16 x 12 cm, stiff enough to sink 2 mm under the XRB's weight.
constexpr std::array<std::array<double, 2>, 4> kSkidCorners{
    {{.08, .06}, {-.08, .06}, {-.08, -.06}, {.08, -.06}}};
constexpr double kSkidStiffness = 260.0;  // N/m per corner
constexpr double kSkidDamping = 6.0;      // N s/m per corner
constexpr double kFriction = 0.5;
constexpr double kFrictionSpeed = 0.02;  // m/s, below which Coulomb friction is smoothed

/// A unit axis at `scale` times the angle of `axis` from z, in the same direction.
Eigen::Vector3d scaledTilt(const Eigen::Vector3d& axis, double scale) {
  const double horizontal2 = axis.x() * axis.x() + axis.y() * axis.y();
  if (horizontal2 < 1e-18) return Eigen::Vector3d::UnitZ();
  const double angle = scale * std::atan2(std::sqrt(horizontal2), axis.z());
  const double stretch = std::sin(angle) / std::sqrt(horizontal2);
  return {stretch * axis.x(), stretch * axis.y(), std::cos(angle)};
}

Eigen::Vector3d turnedAboutZ(const Eigen::Vector3d& v, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {c * v.x() - s * v.y(), s * v.x() + c * v.y(), v.z()};
}

/// Moment of the hub's spring: 2 k_s times the tilt angle, about z x axis.
Eigen::Vector3d hingeMoment(const Eigen::Vector3d& axis, double stiffness) {
  const Eigen::Vector3d about(-axis.y(), axis.x(), 0.0);
  const double sine = about.norm();
  if (sine < 1e-12) return Eigen::Vector3d::Zero();
  return 2.0 * stiffness * std::atan2(sine, axis.z()) / sine * about;
}

/// Cheeseman and Bennett 1955: thrust over free-air thrust at rotor height h is 1 / (1 - (R / 4h)^2).
double groundEffect(double rotor_height, double radius, double scale) {
  const double ratio = radius / (4.0 * std::max(0.08, rotor_height));
  return 1.0 + scale * (1.0 / (1.0 - std::min(0.2, ratio * ratio)) - 1.0);
}

Eigen::Quaterniond rotationOf(double w, double x, double y, double z) {
  return Eigen::Quaterniond(w, x, y, z).normalized();
}

}  // namespace

Dynamics::Dynamics(const HelicopterParameters& parameters) : parameters_(parameters), x_(State::Zero()) {
  placeOnGround(0, 0, 0);
}

void Dynamics::placeOnGround(double x, double y, double yaw) {
  x_.setZero();
  x_.segment<3>(kPosition) << x, y, parameters_.standing_height;
  x_[kRotation] = std::cos(0.5 * yaw);
  x_[kRotation + 3] = std::sin(0.5 * yaw);
  x_[kBar + 2] = 1.0;
  x_[kTipPath + 2] = 1.0;
  swash_roll_ = swash_pitch_ = 0.0;
  on_ground_ = true;
  hardest_touch_ = 0.0;
}

void Dynamics::setState(const HelicopterState& state) {
  const Eigen::Quaterniond& q = state.world_from_body.rotation;
  x_.segment<3>(kPosition) = state.world_from_body.translation;
  x_.segment<3>(kVelocity) = state.velocity_in_world;
  x_.segment<4>(kRotation) << q.w(), q.x(), q.y(), q.z();
  x_.segment<3>(kSpin) = state.angular_velocity_in_body;
}

HelicopterState Dynamics::state() const {
  HelicopterState s;
  s.world_from_body.rotation =
      rotationOf(x_[kRotation], x_[kRotation + 1], x_[kRotation + 2], x_[kRotation + 3]);
  s.world_from_body.translation = x_.segment<3>(kPosition);
  s.velocity_in_world = x_.segment<3>(kVelocity);
  s.angular_velocity_in_body = x_.segment<3>(kSpin);
  return s;
}

Dynamics::Wrench Dynamics::rotors(const State& x, Eigen::Vector3d* tip_path_target) const {
  const RotorParameters &up = parameters_.upper, &lo = parameters_.lower;
  const double upper_speed = x[kUpperSpeed], lower_speed = x[kLowerSpeed], z = x[kPosition + 2];

  const Eigen::Vector3d bar = x.segment<3>(kBar).normalized();
  const Eigen::Vector3d upper_axis =
      turnedAboutZ(scaledTilt(bar, up.linkage), up.phase_slope * upper_speed + up.phase_offset);
  const Eigen::Vector3d lower_axis = x.segment<3>(kTipPath).normalized();
  const Eigen::Vector3d swash(std::sin(swash_pitch_), -std::sin(swash_roll_) * std::cos(swash_pitch_),
                              std::cos(swash_roll_) * std::cos(swash_pitch_));
  *tip_path_target =
      turnedAboutZ(scaledTilt(swash, lo.linkage), -(lo.phase_slope * lower_speed + lo.phase_offset));

  const double upper_thrust =
      up.thrust_coefficient * upper_speed * upper_speed *
      groundEffect(z + up.height, parameters_.rotor_radius, parameters_.ground_effect);
  const double lower_thrust =
      lo.thrust_coefficient * lower_speed * lower_speed *
      groundEffect(z + lo.height, parameters_.rotor_radius, parameters_.ground_effect);
  Wrench w;  // force still in the body here
  w.force_in_world = upper_thrust * upper_axis + lower_thrust * lower_axis;
  w.moment_in_body = up.height * upper_thrust * Eigen::Vector3d(-upper_axis.y(), upper_axis.x(), 0.0) +
                     lo.height * lower_thrust * Eigen::Vector3d(-lower_axis.y(), lower_axis.x(), 0.0) +
                     hingeMoment(upper_axis, up.hinge_stiffness) +
                     hingeMoment(lower_axis, lo.hinge_stiffness);
  w.moment_in_body.z() =
      -up.drag_coefficient * upper_speed * upper_speed + lo.drag_coefficient * lower_speed * lower_speed;
  w.moment_in_body += Eigen::Vector3d(-parameters_.thrust_offset_x, -parameters_.thrust_offset_y, 0.0)
                          .cross(Eigen::Vector3d(0.0, 0.0, w.force_in_world.z()));
  return w;
}

Dynamics::Wrench Dynamics::ground(const State& x, const Eigen::Matrix3d& world_from_body,
                                  bool* touching) const {
  Wrench w{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
  const Eigen::Vector3d spin = x.segment<3>(kSpin);
  for (const auto& corner : kSkidCorners) {
    const Eigen::Vector3d in_body(corner[0], corner[1], -parameters_.standing_height);
    const double height = x[kPosition + 2] + world_from_body.row(2).dot(in_body);
    if (height >= 0.0) continue;
    *touching = true;
    const Eigen::Vector3d velocity = x.segment<3>(kVelocity) + world_from_body * spin.cross(in_body);
    const double normal = std::max(0.0, -kSkidStiffness * height - kSkidDamping * velocity.z());
    const double slide = std::max(velocity.head<2>().norm(), kFrictionSpeed);
    const Eigen::Vector3d force(-kFriction * normal * velocity.x() / slide,
                                -kFriction * normal * velocity.y() / slide, normal);
    w.force_in_world += force;
    w.moment_in_body += in_body.cross(world_from_body.transpose() * force);
  }
  return w;
}

Dynamics::State Dynamics::derivative(const State& x, const StickDemand& demand, const Gust& gust,
                                     bool* touching) const {
  const HelicopterParameters& p = parameters_;
  const Eigen::Matrix3d world_from_body =
      rotationOf(x[kRotation], x[kRotation + 1], x[kRotation + 2], x[kRotation + 3]).toRotationMatrix();
  const Eigen::Vector3d velocity = x.segment<3>(kVelocity), spin = x.segment<3>(kSpin);

  Eigen::Vector3d tip_path_target;
  Wrench w = rotors(x, &tip_path_target);
  const Eigen::Vector3d air = world_from_body.transpose() * (velocity - gust.wind_in_world);
  const Eigen::Vector3d quadratic = -0.5 * kAirDensity * p.drag_coefficient *
                                    Eigen::Vector3d(p.drag_area_x, p.drag_area_y, p.drag_area_z)
                                        .cwiseProduct(air.cwiseAbs().cwiseProduct(air));
  const Eigen::Vector3d damping =
      -Eigen::Vector3d(p.lateral_damping, p.lateral_damping, p.vertical_damping).cwiseProduct(air);
  w.force_in_world = world_from_body * (w.force_in_world + quadratic + damping);
  w.moment_in_body += gust.moment_in_body;
  const Wrench contact = ground(x, world_from_body, touching);
  w.force_in_world += contact.force_in_world;
  w.moment_in_body += contact.moment_in_body;

  State d;
  d.segment<3>(kPosition) = velocity;
  d.segment<3>(kVelocity) = w.force_in_world / p.mass - Eigen::Vector3d(0, 0, kGravity);
  const double qw = x[kRotation], qx = x[kRotation + 1], qy = x[kRotation + 2], qz = x[kRotation + 3];
  d.segment<4>(kRotation) << 0.5 * (-qx * spin.x() - qy * spin.y() - qz * spin.z()),
      0.5 * (qw * spin.x() + qy * spin.z() - qz * spin.y()),
      0.5 * (qw * spin.y() - qx * spin.z() + qz * spin.x()),
      0.5 * (qw * spin.z() + qx * spin.y() - qy * spin.x());
  const Eigen::Vector3d inertia(p.inertia_x, p.inertia_y, p.inertia_z);
  d.segment<3>(kSpin) =
      (w.moment_in_body - spin.cross(Eigen::Vector3d(inertia.cwiseProduct(spin)))).cwiseQuotient(inertia);

  const auto commanded = [&](const RotorParameters& rotor, double stick) {
    return std::clamp(rotor.motor_gain * stick + rotor.motor_offset, 0.0, p.maximum_rotor_speed);
  };
  d[kUpperSpeed] = (commanded(p.upper, demand.upper_rotor) - x[kUpperSpeed]) / p.upper.motor_time;
  d[kLowerSpeed] = (commanded(p.lower, demand.lower_rotor) - x[kLowerSpeed]) / p.lower.motor_time;

  // The bar keeps its axis in space; its angle to the shaft decays with T_b.
  const Eigen::Vector3d bar = x.segment<3>(kBar).normalized();
  const double sine = bar.head<2>().norm();
  Eigen::Vector3d relax = Eigen::Vector3d::Zero();
  if (sine > 1e-8)
    relax = Eigen::Vector3d(-bar.x() * bar.z() / sine, -bar.y() * bar.z() / sine, sine) *
            std::atan2(sine, bar.z()) / p.bar_time;
  d.segment<3>(kBar) = relax - spin.cross(bar);
  const Eigen::Vector3d tip_path = x.segment<3>(kTipPath).normalized();
  d.segment<3>(kTipPath) = (tip_path_target - tip_path) / p.lower_tip_path_time - spin.cross(tip_path);
  return d;
}

void Dynamics::step(const StickDemand& demand, const Gust& gust, double dt) {
  const HelicopterParameters& p = parameters_;
  StickDemand limited;
  limited.upper_rotor = std::clamp(demand.upper_rotor, 0.0, 1.0);
  limited.lower_rotor = std::clamp(demand.lower_rotor, 0.0, 1.0);
  const auto servo = [&](double& angle, double stick, double offset) {
    const double target = (std::clamp(stick, -1.0, 1.0) + offset) * p.swash_plate_range;
    angle += std::clamp(target - angle, -p.swash_plate_rate * dt, p.swash_plate_rate * dt);
  };
  servo(swash_roll_, demand.roll, p.swash_plate_offset_roll);
  servo(swash_pitch_, demand.pitch, p.swash_plate_offset_pitch);

  const double sinking = -x_[kVelocity + 2];
  bool touching = false;
  const State k1 = derivative(x_, limited, gust, &touching);
  const State k2 = derivative(x_ + 0.5 * dt * k1, limited, gust, &touching);
  const State k3 = derivative(x_ + 0.5 * dt * k2, limited, gust, &touching);
  const State k4 = derivative(x_ + dt * k3, limited, gust, &touching);
  x_ += dt / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
  x_.segment<4>(kRotation).normalize();
  x_.segment<3>(kBar).normalize();
  x_.segment<3>(kTipPath).normalize();
  if (touching && !on_ground_) hardest_touch_ = std::max(hardest_touch_, sinking);
  on_ground_ = touching;
}

}  // namespace helical
