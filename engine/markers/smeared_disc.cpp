#include "engine/markers/smeared_disc.h"

#include <algorithm>
#include <cmath>

#include "engine/markers/disc_descent.h"

namespace helical {
namespace {

/// Moments are about a cell apart, two on the longest ways, so that a cell's outline, as wide as that, hides
/// their steps.
constexpr int kFewestMoments = 3, kMostMoments = 48;
constexpr double kLonger = 1.2;  ///< than at the start, a way may become

}  // namespace

double SmearedDisc::halfLength() const {
  const double x = motion.half_x, y = motion.half_y;
  return std::sqrt(x * x + y * y);
}

void SmearedDisc::descend(DiscCells& cells, int steps) {
  const int needed = 1 + static_cast<int>(std::ceil(kLonger * 2.0 * halfLength()));
  motion.moments = std::clamp(needed, kFewestMoments, kMostMoments);
  descendTo(*this, cells, steps);
}

DiscSums SmearedDisc::measure(DiscCells& cells) const {
  DiscSums sums;
  measureSmearedDisc(disc, motion, cells, sums);
  return sums;
}

SmearedDisc SmearedDisc::moved(const Eigen::Matrix<double, kSize, 1>& change) const {
  SmearedDisc to = *this;
  for (int k = 0; k < kDiscParameters; ++k)
    to.disc[static_cast<std::size_t>(k)] += static_cast<float>(change[k]);
  to.motion.half_x += static_cast<float>(change[kSmearHalfX]);
  to.motion.half_y += static_cast<float>(change[kSmearHalfY]);
  return to;
}

}  // namespace helical
