#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <cstring>
#include <type_traits>

namespace helical {

/// The newest value from one writer to any readers, also in memory that processes share: a sequence lock.
/// Wait-free for the writer; a reader that meets a writer's death in the middle of a write gets nothing, and
/// does not wait.
template <class T>
class Seqlock {
  static_assert(std::is_trivially_copyable_v<T>);
  static_assert(std::atomic<std::uint64_t>::is_always_lock_free);

 public:
  void write(const T& value) {
    Words words{};
    std::memcpy(words.data(), &value, sizeof value);
    const std::uint64_t sequence = sequence_.load(std::memory_order_relaxed) | 1;
    sequence_.store(sequence, std::memory_order_relaxed);
    for (std::size_t i = 0; i < kWords; ++i) {
      // Each word after the odd number, and the even number after each word.
      words_[i].store(words[i], std::memory_order_release);
    }
    sequence_.store(sequence + 1, std::memory_order_release);
  }

  /// False when there is no whole value: none was written yet, or the writer is in the way.
  bool read(T& value) const {
    for (int attempt = 0; attempt < kAttempts; ++attempt) {
      const std::uint64_t before = sequence_.load(std::memory_order_acquire);
      if (before == 0) return false;
      if ((before & 1) != 0) continue;
      Words words;
      for (std::size_t i = 0; i < kWords; ++i) words[i] = words_[i].load(std::memory_order_acquire);
      if (sequence_.load(std::memory_order_relaxed) != before) continue;
      std::memcpy(static_cast<void*>(&value), words.data(), sizeof value);
      return true;
    }
    return false;
  }

 private:
  static constexpr std::size_t kWords = (sizeof(T) + 7) / 8;
  static constexpr int kAttempts = 100;
  using Words = std::array<std::uint64_t, kWords>;

  std::atomic<std::uint64_t> sequence_{0};
  std::array<std::atomic<std::uint64_t>, kWords> words_{};
};

}  // namespace helical
