#include "engine/markers/cut_disc.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "engine/markers/disc_normal.h"

namespace helical {
namespace {

constexpr float kFlat = 0.15F;
constexpr double kSettled = 2e-3;  ///< cells: a smaller step is the last
constexpr double kFirstDamping = 0.01, kMostDamping = 1e4;
constexpr double kFarthest = 0.5;  ///< radii: of one step

constexpr int kSteps = 12;
constexpr std::size_t kTries = 3;  ///< of the directions that something may hide a part from
/// A disc of which a quarter is hidden: its radius over that of a disc of what is seen; from that radius on,
/// how far its centre lies from the centre of gravity, and the edge from its centre.
constexpr float kRadius = 1.12F, kShift = 0.24F, kOffset = 0.4F;
constexpr float kDiagonal = 0.70710678F;
constexpr std::array<std::array<float, 2>, 8> kDirections{{{1.0F, 0.0F},
                                                           {kDiagonal, kDiagonal},
                                                           {0.0F, 1.0F},
                                                           {-kDiagonal, kDiagonal},
                                                           {-1.0F, 0.0F},
                                                           {-kDiagonal, -kDiagonal},
                                                           {0.0F, -1.0F},
                                                           {kDiagonal, -kDiagonal}}};

using Normal = Eigen::Matrix<double, kCutParameters, kCutParameters>;
using Vector = Eigen::Matrix<double, kCutParameters, 1>;

Normal normalWithPrior(const DiscSums& sums, double ambient) {
  Normal normal = normalOf<kCutParameters>(sums);
  normal.diagonal().array() += 1e-9;
  normal(kDiscLightZ, kDiscLightZ) += lightPrior(ambient);
  return normal;
}

CutDisc moved(const CutDisc& from, const Vector& change) {
  CutDisc to = from;
  for (int k = 0; k < kDiscParameters; ++k)
    to.disc[static_cast<std::size_t>(k)] += static_cast<float>(change[k]);
  to.edge.offset += static_cast<float>(change[kCutOffset]);
  to.edge.level += static_cast<float>(change[kCutLevel]);
  const auto turn = static_cast<float>(change[kCutTurn]);
  const float x = from.edge.normal_x - turn * from.edge.normal_y,
              y = from.edge.normal_y + turn * from.edge.normal_x;
  const float length = std::sqrt(x * x + y * y);
  to.edge.normal_x = x / length;
  to.edge.normal_y = y / length;
  return to;
}

CutDisc cutFrom(const std::array<float, 2>& normal, const std::array<float, kDiscParameters>& disc) {
  CutDisc cut;
  cut.disc = disc;
  const float radius = kRadius * disc[kDiscRadius], shift = kShift * radius;
  cut.disc[kDiscRadius] = radius;
  cut.disc[kDiscX] += shift * normal[0];
  cut.disc[kDiscY] += shift * normal[1];
  cut.edge = {cut.disc[kDiscX], cut.disc[kDiscY], normal[0], normal[1], kOffset * radius, disc[kDiscAround]};
  return cut;
}

}  // namespace

CutDisc nearestCut(const std::array<float, kDiscParameters>& disc, DiscCells& cells) {
  std::array<CutDisc, kDirections.size()> cuts;
  DiscSums sums;
  for (std::size_t i = 0; i < cuts.size(); ++i) {
    cuts[i] = cutFrom(kDirections[i], disc);
    cuts[i].evaluate(cells);
    sumDisc(cells, sums);
    cuts[i].squares = sums.squares;
  }
  const auto isBetter = [](const CutDisc& a, const CutDisc& b) { return a.squares < b.squares; };
  const auto tried = cuts.begin() + kTries;
  std::partial_sort(cuts.begin(), tried, cuts.end(), isBetter);
  std::for_each(cuts.begin(), tried, [&](CutDisc& cut) { cut.descend(cells, kSteps); });
  CutDisc best = *std::min_element(cuts.begin(), tried, isBetter);
  best.evaluate(cells);
  return best;
}

bool hasShadow(const std::array<float, kDiscParameters>& disc) {
  const float x = disc[kDiscLightX], y = disc[kDiscLightY], z = disc[kDiscLightZ],
              flat = kFlat * disc[kDiscAmbient];
  return x * x + y * y + z * z > flat * flat;
}

void CutDisc::evaluate(DiscCells& cells) const {
  evaluateDisc(disc, hasShadow(disc), cells);
  cutDisc(edge, cells);
}

void CutDisc::descend(DiscCells& cells, int steps) {
  DiscSums sums;
  const auto cost = [&](const CutDisc& at) {
    const double light = at.disc[kDiscLightZ];
    return sums.squares + lightPrior(at.disc[kDiscAmbient]) * light * light;
  };
  evaluate(cells);
  sumCutDisc(cells, sums);
  squares = sums.squares;
  count = sums.count;
  double least = cost(*this), damping = kFirstDamping;
  for (int step = 0; step < steps && damping < kMostDamping;) {
    const double ambient = disc[kDiscAmbient], prior = lightPrior(ambient);
    const Normal normal = normalWithPrior(sums, ambient);
    Vector gradient = Eigen::Map<const Vector>(sums.gradient.data());
    gradient[kDiscLightZ] -= prior * disc[kDiscLightZ];
    for (bool is_better = false; !is_better && step < steps && damping < kMostDamping; ++step) {
      Normal damped = normal;
      damped.diagonal() *= 1.0 + damping;
      Vector change = damped.ldlt().solve(gradient);
      const double length = std::sqrt(change.head<3>().squaredNorm()), most = kFarthest * disc[kDiscRadius];
      if (!(length < 1e6)) return;
      if (length > most) change *= most / length;
      CutDisc next = moved(*this, change);
      next.disc[kDiscRadius] = std::max(next.disc[kDiscRadius], kSmallestDisc);
      next.evaluate(cells);
      sumCutDisc(cells, sums);
      is_better = cost(next) < least;
      damping *= is_better ? 0.1 : 10.0;
      if (!is_better) continue;
      least = cost(next);
      *this = next;
      squares = sums.squares;
      count = sums.count;
      if (length < kSettled) return;
    }
  }
}

Eigen::Matrix2d CutDisc::covariance(DiscCells& cells, double least_variance) const {
  DiscSums sums;
  sumCutDisc(cells, sums);
  const Normal inverse = normalWithPrior(sums, disc[kDiscAmbient]).ldlt().solve(Normal::Identity());
  const double variance = sums.squares / std::max(1.0, sums.count - double{kCutParameters});
  return std::max(least_variance, variance) * inverse.topLeftCorner<2, 2>();
}

}  // namespace helical
