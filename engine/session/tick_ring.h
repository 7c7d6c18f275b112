#pragma once

#include <algorithm>
#include <vector>

#include "engine/pipeline/snapshot.h"

namespace helical {

/// The newest control ticks that nobody has taken yet, at most `most`. Keeps its memory: a snapshot has some
/// 24 KB, and a deque of them costs a scrub more in page faults than all the reading. One thread.
class TickRing {
 public:
  explicit TickRing(std::size_t most) : most_(most) {}

  void clear() { first_ = count_ = 0; }
  /// False if the oldest one had to make room.
  bool push(const EngineSnapshot& tick) {
    if (count_ == slots_.size() && count_ < most_) grow();
    const bool room = count_ < slots_.size();
    if (!room) first_ = (first_ + 1) % slots_.size();
    count_ += room;
    slots_[(first_ + count_ - 1) % slots_.size()] = tick;
    return room;
  }
  bool pop(EngineSnapshot& tick) {
    if (count_ == 0) return false;
    tick = slots_[first_];
    first_ = (first_ + 1) % slots_.size();
    --count_;
    return true;
  }

 private:
  void grow() {
    std::rotate(slots_.begin(), slots_.begin() + static_cast<std::ptrdiff_t>(first_), slots_.end());
    first_ = 0;
    slots_.resize(std::min(most_, std::max<std::size_t>(256, 2 * slots_.size())));
  }

  std::size_t most_;
  std::vector<EngineSnapshot> slots_;
  std::size_t first_ = 0, count_ = 0;
};

}  // namespace helical
