#pragma once

#include <atomic>

#include "engine/base/latest_value.h"
#include "engine/markers/extractor.h"

namespace helical {

/// What others want of a camera's extractor, which runs on the camera's capture thread: the newest order of
/// each kind is carried out before the next frame. Wait-free for the capture thread; each kind of order is
/// for one thread at a time.
class ExtractorOrders {
 public:
  /// The field is empty now: take its picture anew.
  void takeBackground() { background_.store(true, std::memory_order_release); }
  /// These areas in place of all former ones.
  void ignore(const IgnoredAreas& areas);
  /// Other colours than the options'.
  void seek(const MarkerColours& colours);
  /// The balls should be here; wait-free for the giving thread, too.
  void expect(const BallPredictions& predictions);

  /// Capture thread.
  void carryOut(Extractor& extractor);
  /// The same for a source without an extractor: the newest areas, valid until the next call.
  const IgnoredAreas& newestAreas();

 private:
  std::atomic<bool> background_{false};
  LatestValue<IgnoredAreas> areas_;
  LatestValue<MarkerColours> colours_;
  LatestValue<BallPredictions> predictions_;
};

}  // namespace helical
