#include "engine/calibration/particle_likelihood.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "engine/calibration/exponential.h"

namespace helical {
namespace {

constexpr double kNearestDepth = 0.05;
constexpr double kUnseen = 1e6;  // squared standard deviations of a ball behind the camera
constexpr std::size_t kBlock = 256;

/// Pointers to a block of particles, so that the compiler sees plain arrays.
struct Block {
  std::array<const double*, 12> pose;
  std::size_t count;
};

/// Squared distances from the centroid in standard deviations.
void squaredDistances(const Block& block, const BearingTarget& target, double* result) {
  const double x = target.ball_in_world.x(), y = target.ball_in_world.y(), z = target.ball_in_world.z();
  const double u = target.bearing.x(), v = target.bearing.y();
  const double a = target.whitening(0, 0), b = target.whitening(0, 1);
  const double c = target.whitening(1, 0), d = target.whitening(1, 1);
  const auto& p = block.pose;
  for (std::size_t i = 0; i < block.count; ++i) {
    const double in_x = p[0][i] * x + p[1][i] * y + p[2][i] * z + p[9][i];
    const double in_y = p[3][i] * x + p[4][i] * y + p[5][i] * z + p[10][i];
    const double depth = p[6][i] * x + p[7][i] * y + p[8][i] * z + p[11][i];
    const double inverse = 1.0 / (depth > kNearestDepth ? depth : kNearestDepth);
    const double du = in_x * inverse - u;
    const double dv = in_y * inverse - v;
    const double first = a * du + b * dv;
    const double second = c * du + d * dv;
    result[i] = depth > kNearestDepth ? first * first + second * second : kUnseen;
  }
}

}  // namespace

void logLikelihoods(const ParticleCloud& cloud, std::span<const BearingTarget> targets, double floor,
                    LikelihoodProduct product, std::span<double> result) {
  std::array<double, kBlock> squared, total;
  for (std::size_t start = 0; start < result.size(); start += kBlock) {
    Block block;
    block.count = std::min(kBlock, result.size() - start);
    for (int row = 0; row < 12; ++row)
      block.pose[static_cast<std::size_t>(row)] = cloud.column(row).data() + start;
    double peak = 1.0;
    total.fill(product == LikelihoodProduct::kPerMarker ? 1.0 : 0.0);
    for (const BearingTarget& target : targets) {
      peak = target.peak;
      squaredDistances(block, target, squared.data());
      if (product == LikelihoodProduct::kPerMarker)
        for (std::size_t i = 0; i < block.count; ++i)
          total[i] *= peak * expOfNegative(-0.5 * squared[i]) + floor;
      else
        for (std::size_t i = 0; i < block.count; ++i) total[i] += squared[i];
    }
    if (product == LikelihoodProduct::kPerCamera)
      for (std::size_t i = 0; i < block.count; ++i) total[i] = peak * expOfNegative(-0.5 * total[i]) + floor;
    for (std::size_t i = 0; i < block.count; ++i) result[start + i] = std::log(total[i]);
  }
}

}  // namespace helical
