#include "engine/simulator/disturbed_source.h"

#include "engine/simulator/random_streams.h"

namespace helical {

DisturbedSource::DisturbedSource(std::unique_ptr<ObservationSource> source, const CameraModel& model,
                                 const SimulationOptions& options)
    : source_(std::move(source)),
      model_(model),
      noise_(options.noise),
      random_(randomStream(options.seed, RandomStream::kObservations, source_->camera())) {}

bool DisturbedSource::poll(Observation& observation) {
  if (!source_->poll(observation)) return false;
  int kept = 0;
  for (int c = 0; c < observation.count; ++c) {
    Centroid centroid = observation.centroids[static_cast<std::size_t>(c)];
    const bool lost = random_.uniform() < noise_.lost_markers;
    const bool thrown = random_.uniform() < noise_.outliers;
    const Eigen::Vector2d aside =
        kOutlierReachPx * Eigen::Vector2d(random_.uniform(-1.0, 1.0), random_.uniform(-1.0, 1.0));
    if (thrown) centroid.pixel += aside;
    if (lost || !model_.contains(centroid.pixel, centroid.radius_px)) continue;
    observation.centroids[static_cast<std::size_t>(kept++)] = centroid;
  }
  observation.count = kept;
  return true;
}

}  // namespace helical
