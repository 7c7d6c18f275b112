#include "engine/tracking/jump_guard.h"

#include <algorithm>

namespace helical {
namespace {

constexpr double kFastest = 3.0;  // m/s; faster than 2.5 m/s it is landed
constexpr double kSlack = 0.1;    // m: the place from which it came is not known better after a gap
constexpr int kLostAfter = 5;

}  // namespace

bool JumpGuard::believes(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double passed_s) {
  const bool within_reach = (to - from).norm() <= kFastest * std::max(0.0, passed_s) + kSlack;
  const bool believed = within_reach || rejected_ >= kLostAfter;
  rejected_ = believed ? 0 : rejected_ + 1;
  return believed;
}

}  // namespace helical
