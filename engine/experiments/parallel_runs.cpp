#include "engine/experiments/parallel_runs.h"

#include <algorithm>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace helical {
namespace {

/// What the workers share.
class Runs {
 public:
  explicit Runs(int runs) : runs_(runs) {}

  /// The next run to do, or -1.
  int next() {
    const std::lock_guard lock(mutex_);
    return next_ < runs_ && !error_ ? next_++ : -1;
  }

  void finish(std::exception_ptr error) {
    const std::lock_guard lock(mutex_);
    if (error && !error_) error_ = error;
    ++done_;
    changed_.notify_one();
  }

  /// Blocks until more runs are done than `known`; false when there will be no more.
  bool waitForMore(int& known) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return done_ > known || error_; });
    known = done_;
    return !error_ && done_ < runs_;
  }

  std::exception_ptr error() const { return error_; }

 private:
  int runs_;
  std::mutex mutex_;
  std::condition_variable changed_;
  int next_ = 0;
  int done_ = 0;
  std::exception_ptr error_;
};

void workOn(Runs& runs, const std::function<void(int)>& work) {
  for (int run = runs.next(); run >= 0; run = runs.next()) {
    std::exception_ptr error;
    try {
      work(run);
    } catch (...) {
      error = std::current_exception();
    }
    runs.finish(error);
  }
}

}  // namespace

void forEachRun(int count, const std::function<void(int)>& work, const std::function<void(int)>& progress) {
  if (count <= 0) return;
  Runs runs(count);
  {
    std::vector<std::jthread> workers;
    const int threads = std::clamp(static_cast<int>(std::thread::hardware_concurrency()), 1, count);
    for (int t = 0; t < threads; ++t) workers.emplace_back([&] { workOn(runs, work); });
    int done = 0;
    while (runs.waitForMore(done)) progress(done);
  }
  if (runs.error()) std::rethrow_exception(runs.error());
  progress(count);
}

}  // namespace helical
