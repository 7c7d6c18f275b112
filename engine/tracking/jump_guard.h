#pragma once

#include <Eigen/Core>

namespace helical {

/// Nothing that flies jumps: a place that it could not have reached is not believed. When five in a row are
/// out of reach it was the old place that was wrong: the helicopter counts as lost, and the next place found
/// is believed. One thread.
class JumpGuard {
 public:
  /// Whether it may be at `to` if it was at `from` so long ago.
  bool believes(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double passed_s);

 private:
  int rejected_ = 0;  ///< in a row
};

}  // namespace helical
