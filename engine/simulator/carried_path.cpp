#include "engine/simulator/carried_path.h"

#include <algorithm>
#include <cmath>

#include "engine/geometry/rotation.h"

namespace helical {
namespace {

constexpr double kStands = 2.5, kLifts = 1.5;               // s at the beginning
constexpr double kSinks = 2.0, kStandsAgain = 0.5;          // s at the end
constexpr double kHandHeight = 0.5;                         // m above the pad
constexpr std::array<double, 6> kReach{0.45, 0.45, 0.30, 0.30, 0.30, 0.50};  // m, rad
constexpr double kSecondWave = 0.4;                         // of the first one's size
constexpr double kDifference = 1e-4;                        // s, for velocities

double smoothStep(double u) {
  u = std::clamp(u, 0.0, 1.0);
  return u * u * u * (u * (6.0 * u - 15.0) + 10.0);
}

}  // namespace

CarriedPath::CarriedPath(double duration_s, const RigidTransform& put_down, Random random)
    : duration_s_(duration_s), put_down_(put_down) {
  for (std::size_t axis = 0; axis < kAxes; ++axis) {
    waves_[axis][0] = {kReach[axis] / (1.0 + kSecondWave), random.uniform(0.12, 0.28),
                       random.uniform(0.0, 2.0 * kPi)};
    waves_[axis][1] = {kSecondWave * waves_[axis][0].size, random.uniform(0.4, 0.8),
                       random.uniform(0.0, 2.0 * kPi)};
  }
}

RigidTransform CarriedPath::poseAt(double time_s) const {
  const double held = smoothStep((time_s - kStands) / kLifts) *
                      (1.0 - smoothStep((time_s - (duration_s_ - kSinks - kStandsAgain)) / kSinks));
  std::array<double, kAxes> waved{};
  for (std::size_t axis = 0; axis < kAxes; ++axis)
    for (const Wave& wave : waves_[axis])
      waved[axis] += held * wave.size * std::sin(2.0 * kPi * wave.frequency_hz * time_s + wave.phase);
  // From where it stood to where it is put down while it is in the hand.
  const double there = smoothStep((time_s - kStands - kLifts) / (duration_s_ - kStands - kLifts - kSinks));
  RigidTransform pose;
  pose.translation = {there * put_down_.translation.x() + waved[0], there * put_down_.translation.y() + waved[1],
                      put_down_.translation.z() + held * kHandHeight + waved[2]};
  pose.rotation = expSO3({0.0, 0.0, there * yawOf(put_down_.rotation) + waved[5]}) *
                  expSO3({waved[3], waved[4], 0.0});
  return pose;
}

HelicopterState CarriedPath::at(double time_s) const {
  const RigidTransform before = poseAt(time_s - kDifference), after = poseAt(time_s + kDifference);
  HelicopterState state;
  state.world_from_body = poseAt(time_s);
  state.velocity_in_world = (after.translation - before.translation) / (2.0 * kDifference);
  state.angular_velocity_in_body =
      logSO3(before.rotation.conjugate() * after.rotation) / (2.0 * kDifference);
  return state;
}

}  // namespace helical
