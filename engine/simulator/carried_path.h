#pragma once

#include <array>

#include "engine/base/random.h"
#include "engine/helicopter/helicopter_state.h"

namespace helical {

/// The helicopter in somebody's hands: it stands on the pad, exactly where the world's origin is (it is what says
/// where that is), is taken up and waved through the space above, turned and tilted, and put down again as well as
/// people do. A smooth function of time; any thread.
class CarriedPath {
 public:
  /// `put_down`: where it stands in the end. `random` draws how it is waved.
  CarriedPath(double duration_s, const RigidTransform& put_down, Random random);

  double duration() const { return duration_s_; }  ///< s
  HelicopterState at(double time_s) const;         ///< from 0 to `duration`; before and after it stands

 private:
  struct Wave {
    double size, frequency_hz, phase;
  };
  static constexpr int kAxes = 6, kWaves = 2;
  RigidTransform poseAt(double time_s) const;

  double duration_s_;
  RigidTransform put_down_;
  std::array<std::array<Wave, kWaves>, kAxes> waves_;  ///< x, y, z [m], roll, pitch, yaw [rad]
};

/// Shorter than this nobody carries it anywhere [s].
inline constexpr double kShortestCarry = 10.0;

}  // namespace helical
