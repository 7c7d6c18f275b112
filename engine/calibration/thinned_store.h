#pragma once

#include <algorithm>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "engine/base/check.h"
#include "engine/geometry/rigid_transform.h"

namespace helical {

/// How far apart two poses of the helicopter are [m]; a rotation counts by how far it moves a ball.
inline double poseDistance(const RigidTransform& a, const RigidTransform& b) {
  constexpr double kLeverM = 0.2;
  return (a.translation - b.translation).norm() + kLeverM * a.rotation.angularDistance(b.rotation);
}

/// A bounded memory of things that have a `world_from_body`. When it is full, the one whose helicopter pose
/// differs least from those before and after it makes room: minutes on the ground do not push out seconds of
/// flight, and a pose that only one frame has stays. Allocates at construction only.
template <typename Frame>
class ThinnedStore {
 public:
  explicit ThinnedStore(int capacity) : capacity_(static_cast<std::size_t>(capacity)) {
    HELICAL_CHECK(capacity >= 3);
    slots_.reserve(capacity_);
    order_.reserve(capacity_);
    gap_.reserve(capacity_);
  }

  void clear() {
    slots_.clear();
    order_.clear();
    gap_.clear();
  }

  void add(const Frame& frame) {
    std::size_t slot = slots_.size();
    if (slot < capacity_)
      slots_.emplace_back();
    else
      slot = takeMostRedundant();
    slots_[slot] = frame;
    order_.push_back(&slots_[slot]);
    gap_.push_back(order_.size() > 1 ? distance(order_.size() - 2, order_.size() - 1) : 0.0);
  }

  /// What is done to them must not move their poses.
  template <typename Change>
  void forEach(const Change& change) {
    for (Frame& frame : slots_) change(frame);
  }

  /// In the order of time; valid until the next call.
  std::span<const Frame* const> frames() const { return order_; }

 private:
  double distance(std::size_t earlier, std::size_t later) const {
    return poseDistance(order_[earlier]->world_from_body, order_[later]->world_from_body);
  }

  std::size_t takeMostRedundant() {
    std::size_t redundant = 1;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 1; i + 1 < order_.size(); ++i)
      if (const double detour = gap_[i] + gap_[i + 1]; detour < least) {
        least = detour;
        redundant = i;
      }
    const auto slot = static_cast<std::size_t>(order_[redundant] - slots_.data());
    order_.erase(order_.begin() + static_cast<std::ptrdiff_t>(redundant));
    gap_.erase(gap_.begin() + static_cast<std::ptrdiff_t>(redundant));
    gap_[redundant] = distance(redundant - 1, redundant);
    return slot;
  }

  std::size_t capacity_;
  std::vector<Frame> slots_;
  std::vector<const Frame*> order_;
  std::vector<double> gap_;  ///< of frame i to i - 1
};

}  // namespace helical
