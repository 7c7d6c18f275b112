#include "engine/markers/extractor_orders.h"

namespace helical {

void ExtractorOrders::ignore(const IgnoredAreas& areas) {
  areas_.back() = areas;
  areas_.publish();
}

void ExtractorOrders::seek(const MarkerColours& colours) {
  colours_.back() = colours;
  colours_.publish();
}

void ExtractorOrders::expect(const BallPredictions& predictions) {
  predictions_.back() = predictions;
  predictions_.publish();
}

void ExtractorOrders::carryOut(Extractor& extractor) {
  if (background_.load(std::memory_order_relaxed) && background_.exchange(false, std::memory_order_acquire))
    extractor.takeBackground();
  if (areas_.take()) extractor.setIgnoredAreas(areas_.front());
  if (colours_.take()) extractor.setColours(colours_.front());
  if (predictions_.take()) extractor.expect(predictions_.front());
}

const IgnoredAreas& ExtractorOrders::newestAreas() {
  areas_.take();
  return areas_.front();
}

}  // namespace helical
