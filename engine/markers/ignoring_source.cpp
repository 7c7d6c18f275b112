#include "engine/markers/ignoring_source.h"

#include <algorithm>
#include <utility>

namespace helical {

IgnoringSource::IgnoringSource(std::unique_ptr<ObservationSource> source,
                               std::shared_ptr<ExtractorOrders> orders)
    : source_(std::move(source)), orders_(std::move(orders)) {}

bool IgnoringSource::poll(Observation& observation) {
  if (!source_->poll(observation)) return false;
  const IgnoredAreas& areas = orders_->newestAreas();
  const auto begin = observation.centroids.begin();
  const auto seen =
      std::remove_if(begin, begin + observation.count,
                     [&](const Centroid& centroid) { return isIgnored(areas, centroid.pixel); });
  observation.count = static_cast<int>(seen - begin);
  return true;
}

}  // namespace helical
