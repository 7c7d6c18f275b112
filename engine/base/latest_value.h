#pragma once

#include <array>
#include <atomic>
#include <cstdint>

namespace helical {

/// The newest value from one writer to one reader, wait-free on both sides: a triple buffer. The writer fills
/// `back()` and publishes; the reader takes the newest. Values in between are skipped, never queued.
template <class T>
class LatestValue {
 public:
  /// Writer's thread: the buffer to fill; it holds an older value, not a cleared one.
  T& back() { return buffers_[write_]; }
  /// Writer's thread.
  void publish() {
    write_ = middle_.exchange(static_cast<std::uint8_t>(write_ | kFresh), std::memory_order_acq_rel) & kIndex;
  }

  /// Reader's thread: true if `front()` has changed.
  bool take() {
    if ((middle_.load(std::memory_order_relaxed) & kFresh) == 0) return false;
    read_ = middle_.exchange(read_, std::memory_order_acq_rel) & kIndex;
    return true;
  }
  /// Reader's thread.
  const T& front() const { return buffers_[read_]; }

 private:
  static constexpr std::uint8_t kIndex = 3;
  static constexpr std::uint8_t kFresh = 4;
  std::array<T, 3> buffers_{};
  alignas(64) std::uint8_t write_ = 0;
  alignas(64) std::uint8_t read_ = 2;
  alignas(64) std::atomic<std::uint8_t> middle_{1};
};

}  // namespace helical
