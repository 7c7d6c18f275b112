#pragma once

#include <atomic>
#include <memory>

namespace helical {

/// Brings a heap object to a thread that must neither allocate nor free, and brings back the one that it
/// replaces. One giver, one receiver; wait-free on both sides.
template <class T>
class HandOver {
 public:
  HandOver() = default;
  ~HandOver() {
    delete offered_.load();
    delete returned_.load();
  }
  HandOver(const HandOver&) = delete;
  HandOver& operator=(const HandOver&) = delete;

  /// Giver's thread. An earlier offer that nobody took yet is forgotten.
  void offer(std::unique_ptr<T> value) {
    delete offered_.exchange(value.release(), std::memory_order_acq_rel);
    collect();
  }
  /// Giver's thread: whether the last offer was taken.
  bool taken() const { return offered_.load(std::memory_order_acquire) == nullptr; }
  /// Giver's thread: frees what came back. Until then the receiver takes nothing new.
  void collect() { delete returned_.exchange(nullptr, std::memory_order_acq_rel); }

  /// Receiver's thread: the offer, or nothing.
  std::unique_ptr<T> take() {
    if (returned_.load(std::memory_order_acquire) != nullptr) return nullptr;
    return std::unique_ptr<T>(offered_.exchange(nullptr, std::memory_order_acq_rel));
  }
  /// Receiver's thread, once after each successful `take`.
  void giveBack(std::unique_ptr<T> value) { returned_.store(value.release(), std::memory_order_release); }

 private:
  std::atomic<T*> offered_{nullptr};
  std::atomic<T*> returned_{nullptr};
};

}  // namespace helical
