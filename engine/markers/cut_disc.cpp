#include "engine/markers/cut_disc.h"

#include <algorithm>
#include <cmath>

#include "engine/markers/disc_descent.h"

namespace helical {
namespace {

constexpr std::size_t kTries = 3;  ///< of the directions that something may hide a part from
/// Of each try, and from there on of the best and of those that may come out better: elsewhere, and with no
/// more than so many times its squares.
constexpr int kFirstSteps = 4, kSteps = 8;
constexpr float kElsewhere = 0.25F;  ///< cells
constexpr double kMayBeBetter = 2.0;
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

CutDisc cutFrom(const std::array<float, 2>& normal, const DiscValues& disc) {
  CutDisc cut;
  cut.disc = disc;
  const float radius = kRadius * disc[kDiscRadius], shift = kShift * radius;
  cut.disc[kDiscRadius] = radius;
  cut.disc[kDiscX] += shift * normal[0];
  cut.disc[kDiscY] += shift * normal[1];
  cut.edge = {cut.disc[kDiscX], cut.disc[kDiscY], normal[0], normal[1], kOffset * radius, disc[kDiscAround]};
  return cut;
}

bool isElsewhere(const CutDisc& a, const CutDisc& b) {
  const float x = a.disc[kDiscX] - b.disc[kDiscX], y = a.disc[kDiscY] - b.disc[kDiscY];
  return x * x + y * y > kElsewhere * kElsewhere;
}

}  // namespace

NearestCut nearestCut(const DiscValues& disc, DiscCells& cells) {
  std::array<CutDisc, kDirections.size()> cuts;
  for (std::size_t i = 0; i < cuts.size(); ++i) {
    cuts[i] = cutFrom(kDirections[i], disc);
    cuts[i].squares = cuts[i].measure(cells).squares;
  }
  const auto isBetter = [](const CutDisc& a, const CutDisc& b) { return a.squares < b.squares; };
  const auto tried = cuts.begin() + kTries;
  std::partial_sort(cuts.begin(), tried, cuts.end(), isBetter);
  std::for_each(cuts.begin(), tried, [&](CutDisc& cut) { cut.descend(cells, kFirstSteps); });
  std::sort(cuts.begin(), tried, isBetter);
  CutDisc best = cuts[0];
  best.descend(cells, kSteps);
  for (std::size_t i = 1; i < kTries; ++i) {
    CutDisc& other = cuts[i];
    if (other.squares > kMayBeBetter * best.squares || !isElsewhere(other, best)) continue;
    other.descend(cells, kSteps);
    if (isBetter(other, best)) best = other;
  }
  const DiscSums sums = best.measure(cells);
  return {best, centreCovariance(best, sums, kLeastVariance)};
}

DiscSums CutDisc::measure(DiscCells& cells) const {
  DiscSums sums;
  measureCutDisc(disc, edge, cells, sums);
  return sums;
}

CutDisc CutDisc::moved(const Eigen::Matrix<double, kSize, 1>& change) const {
  CutDisc to = *this;
  for (int k = 0; k < kDiscParameters; ++k)
    to.disc[static_cast<std::size_t>(k)] += static_cast<float>(change[k]);
  to.edge.offset += static_cast<float>(change[kCutOffset]);
  to.edge.level += static_cast<float>(change[kCutLevel]);
  const auto turn = static_cast<float>(change[kCutTurn]);
  const float x = edge.normal_x - turn * edge.normal_y, y = edge.normal_y + turn * edge.normal_x;
  const float length = std::sqrt(x * x + y * y);
  to.edge.normal_x = x / length;
  to.edge.normal_y = y / length;
  return to;
}

void CutDisc::descend(DiscCells& cells, int steps) {
  descendTo(*this, cells, steps);
}

}  // namespace helical
