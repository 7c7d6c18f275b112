#include "engine/calibration/frame_store.h"

#include <algorithm>
#include <limits>

#include "engine/base/check.h"

namespace helical {
namespace {

constexpr double kLeverM = 0.2;  // weighs a rotation by how far it moves a ball

}  // namespace

StoredFrame stored(const CalibrationFrame& frame) {
  StoredFrame copy;
  copy.world_from_body = frame.world_from_body;
  copy.pose_covariance = frame.pose_covariance;
  copy.count = std::min(static_cast<int>(frame.pixels.size()), kMaxMarkers);
  std::copy_n(frame.pixels.begin(), copy.count, copy.pixels.begin());
  return copy;
}

FrameStore::FrameStore(int capacity) : capacity_(static_cast<std::size_t>(capacity)) {
  HELICAL_CHECK(capacity >= 3);
  slots_.reserve(capacity_);
  order_.reserve(capacity_);
  gap_.reserve(capacity_);
}

void FrameStore::clear() {
  slots_.clear();
  order_.clear();
  gap_.clear();
}

double FrameStore::distance(std::size_t earlier, std::size_t later) const {
  const RigidTransform& a = order_[earlier]->world_from_body;
  const RigidTransform& b = order_[later]->world_from_body;
  return (a.translation - b.translation).norm() + kLeverM * a.rotation.angularDistance(b.rotation);
}

std::size_t FrameStore::takeMostRedundant() {
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

void FrameStore::add(const CalibrationFrame& frame) {
  std::size_t slot = slots_.size();
  if (slot < capacity_)
    slots_.emplace_back();
  else
    slot = takeMostRedundant();
  slots_[slot] = stored(frame);
  order_.push_back(&slots_[slot]);
  gap_.push_back(order_.size() > 1 ? distance(order_.size() - 2, order_.size() - 1) : 0.0);
}

std::span<const StoredFrame* const> FrameStore::spread(std::span<const StoredFrame*> selection) const {
  const std::size_t count = std::min(selection.size(), order_.size());
  for (std::size_t i = 0; i < count; ++i) selection[i] = order_[(i + 1) * order_.size() / count - 1];
  return selection.first(count);
}

}  // namespace helical
