#include "engine/correspondence/prediction_naming.h"

#include <Eigen/LU>
#include <algorithm>

namespace helical {
namespace {

struct Pair {
  double distance2;
  int marker;
  int centroid;
};

constexpr std::size_t kMaxPairs = static_cast<std::size_t>(kMaxMarkers) * kMaxCentroids;

/// Regions of two balls merge when their discs touch; a region this much larger than one disc holds more than
/// one.
constexpr double kMergedArea = 1.5;

bool overlapsAnother(std::span<const MarkerPrediction> predictions, int marker) {
  const auto& own = predictions[static_cast<std::size_t>(marker)];
  for (int other = 0; other < static_cast<int>(predictions.size()); ++other) {
    const auto& p = predictions[static_cast<std::size_t>(other)];
    if (other != marker && p.visible && (p.pixel - own.pixel).norm() < own.radius_px + p.radius_px + 2.0)
      return true;
  }
  return false;
}

}  // namespace

Names nameByPrediction(std::span<const MarkerPrediction> predictions, const Observation& observation,
                       double gate_chi2) {
  std::array<Pair, kMaxPairs> pairs;
  std::size_t pair_count = 0;
  for (int m = 0; m < static_cast<int>(predictions.size()); ++m) {
    const auto& prediction = predictions[static_cast<std::size_t>(m)];
    if (!prediction.visible) continue;
    const Eigen::Matrix2d information = prediction.covariance.inverse();
    for (int c = 0; c < observation.count; ++c) {
      const Eigen::Vector2d d = observation.centroids[static_cast<std::size_t>(c)].pixel - prediction.pixel;
      const double distance2 = d.dot(information * d);
      if (distance2 < gate_chi2) pairs[pair_count++] = {distance2, m, c};
    }
  }
  std::sort(pairs.begin(), pairs.begin() + static_cast<std::ptrdiff_t>(pair_count),
            [](const Pair& a, const Pair& b) { return a.distance2 < b.distance2; });

  Names names;
  names.fill(-1);
  std::array<bool, kMaxCentroids> taken{};
  for (std::size_t i = 0; i < pair_count; ++i) {
    const Pair& pair = pairs[i];
    if (names[static_cast<std::size_t>(pair.marker)] >= 0 || taken[static_cast<std::size_t>(pair.centroid)])
      continue;
    names[static_cast<std::size_t>(pair.marker)] = pair.centroid;
    taken[static_cast<std::size_t>(pair.centroid)] = true;
  }

  for (int m = 0; m < static_cast<int>(predictions.size()); ++m) {
    int& name = names[static_cast<std::size_t>(m)];
    if (name < 0 || !overlapsAnother(predictions, m)) continue;
    const double disc = 3.14159 * predictions[static_cast<std::size_t>(m)].radius_px *
                        predictions[static_cast<std::size_t>(m)].radius_px;
    if (observation.centroids[static_cast<std::size_t>(name)].area_px > kMergedArea * disc) name = -1;
  }
  return names;
}

}  // namespace helical
