#include "engine/calibration/lasting_inflation.h"

#include <algorithm>
#include <cmath>

namespace helical {
namespace {

constexpr double kLeastVariance = 1e-4;  // px^2

double typicalVariance(const RigMoment& moment) {
  for (const RigMoment::View& view : moment.views)
    if (view.seen.any()) return view.variance;
  return RigMoment::View().variance;
}

}  // namespace

double lastingInflation(std::span<const RigMoment> moments, double sigma_px, double time_s) {
  if (moments.size() < 2) return 1.0;
  const double span_s = toSeconds(moments.back().time - moments.front().time);
  const double correlation = std::exp(-span_s / static_cast<double>(moments.size() - 1) / time_s);
  return 1.0 + sigma_px * sigma_px / std::max(typicalVariance(moments.front()), kLeastVariance) *
                   (1.0 + correlation) / (1.0 - correlation);
}

}  // namespace helical
