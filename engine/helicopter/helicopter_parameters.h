#pragma once

#include "engine/base/random.h"

namespace helical {

/// One of the two coaxial rotors.
struct RotorParameters {
  double thrust_coefficient;  ///< k_T [N s^2]: thrust = k_T Omega^2
  double drag_coefficient;    ///< k_M [N m s^2]: torque about the shaft = k_M Omega^2
  double height;              ///< d [m], hub above the centre of mass
  double hinge_stiffness;     ///< k_s [N m/rad]
  double linkage;             ///< l: tilt of the tip-path plane over tilt of bar or swash plate
  double motor_time;          ///< T_mot [s]
  double motor_gain;          ///< a [rad/s per unit of stick]
  double motor_offset;        ///< b [rad/s]
  double phase_slope;         ///< m [s]: the tilt's phase angle is m Omega + b [rad]
  double phase_offset;        ///< b [rad]
};

/// Parameters of the coaxial helicopter, SI units. Source: the published CoaX model (mfaessle/coax-control;
/// Fankhauser et al., "Modeling and Decoupling Control of the CoaX Micro Helicopter"). No identified
/// parameters of the XRB are public: `xrb()` is the CoaX with the XRB's mass and inertia, and is an
/// assumption.
struct HelicopterParameters {
  double mass = 0.21;
  double inertia_x = 1.837e-3 * 0.695;
  double inertia_y = 1.837e-3 * 0.695;
  double inertia_z = 2.779e-4 * 0.695;
  RotorParameters upper{2.2607e-5, 9.9708e-7, 0.165,  0.0542,    0.6130,
                        0.185,     421.37,    -0.256, -0.001282, 0.1789};
  RotorParameters lower{3.1531e-5, 8.9737e-7, 0.103,  0.2139,   0.5176,
                        0.115,     437.70,    -2.905, 0.001282, -0.0094};
  double maximum_rotor_speed = 320.0;     ///< rad/s
  double bar_time = 1.6;                  ///< T_b, stabiliser bar [s]
  double lower_tip_path_time = 0.08;      ///< T_f, lag of the lower rotor's tip-path plane [s]
  double swash_plate_range = 0.26;        ///< rad at full stick
  double swash_plate_rate = 2.375;        ///< rad/s
  double drag_coefficient = 1.05;         ///< quadratic drag of the fuselage
  double drag_area_x = 0.02;              ///< m^2
  double drag_area_y = 0.02;              ///< m^2
  double drag_area_z = 0.019;             ///< m^2
  double lateral_damping = 0.05;          ///< rotor damping [N s/m]
  double vertical_damping = 0.10;         ///< rotor damping [N s/m]
  double ground_effect = 1.0;             ///< scale of the Cheeseman-Bennett term; 0 switches it off
  double rotor_radius = 0.17;             ///< m
  double standing_height = 0.06;          ///< of the origin above the ground, standing on the skids [m]
  double thrust_offset_x = 0.0;           ///< of the thrust line from the centre of mass [m]
  double thrust_offset_y = 0.0;           ///< m
  double swash_plate_offset_roll = 0.0;   ///< fraction of full stick
  double swash_plate_offset_pitch = 0.0;  ///< fraction of full stick

  static HelicopterParameters xrb() { return {}; }
  static HelicopterParameters coax();

  double hoverSpeedUpper() const;  ///< rad/s, where thrust carries the weight and the torques cancel
  double hoverSpeedLower() const;
  double hoverStickUpper() const;  ///< 0..1
  double hoverStickLower() const;
};

inline constexpr double kGravity = 9.81;

/// Draws every parameter but the standing height uniformly within +-`fraction` of its nominal value, and adds
/// unknown trims (swash-plate offset up to 0.3 `fraction`, thrust line up to 1 cm x `fraction`). Draws again
/// until the helicopter can hover between 30 % and 80 % of the stick, with rotor speed to spare.
HelicopterParameters varied(const HelicopterParameters& nominal, double fraction, Random& random);

}  // namespace helical
