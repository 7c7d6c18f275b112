#include "engine/calibration/particle_likelihood.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include "engine/calibration/vector_math.h"

namespace helical {
namespace {

constexpr float kNearestDepth = 0.05F;
constexpr float kUnseen =
    1e6F;  // squared standard deviations of a ball behind the camera; no more for any other
constexpr std::size_t kBlock = kParticleBlock;
constexpr std::size_t kFactors = 3;         // of a product, none of which is below the least floor
constexpr float kLeastFloorShare = 1e-12F;  // of the peak: a product stays far above the least normal number

/// A block of particles, so that the compiler sees plain arrays.
struct Block {
  std::array<const float*, 12> pose;
  std::size_t count;
};

struct Target {
  explicit Target(const BearingTarget& target)
      : x(static_cast<float>(target.ball_in_world.x())),
        y(static_cast<float>(target.ball_in_world.y())),
        z(static_cast<float>(target.ball_in_world.z())),
        u(static_cast<float>(target.bearing.x())),
        v(static_cast<float>(target.bearing.y())),
        a(static_cast<float>(target.whitening(0, 0))),
        b(static_cast<float>(target.whitening(0, 1))),
        c(static_cast<float>(target.whitening(1, 0))),
        d(static_cast<float>(target.whitening(1, 1))) {}
  float x, y, z, u, v, a, b, c, d;
};

float floorShare(const BearingTarget& target, double floor) {
  return std::max(static_cast<float>(floor / target.peak), kLeastFloorShare);
}

/// Squared distances from the centroid in standard deviations.
inline void squaredDistances(const Block& block, const Target& t, float* result) {
  const auto [p00, p01, p02, p10, p11, p12, p20, p21, p22, t0, t1, t2] = block.pose;
#pragma GCC ivdep
  for (std::size_t i = 0; i < kBlock; ++i) {
    const float in_x = p00[i] * t.x + p01[i] * t.y + p02[i] * t.z + t0[i];
    const float in_y = p10[i] * t.x + p11[i] * t.y + p12[i] * t.z + t1[i];
    const float depth = p20[i] * t.x + p21[i] * t.y + p22[i] * t.z + t2[i];
    const float inverse = 1.0F / (depth > kNearestDepth ? depth : kNearestDepth);
    const float du = in_x * inverse - t.u;
    const float dv = in_y * inverse - t.v;
    const float first = t.a * du + t.b * dv;
    const float second = t.c * du + t.d * dv;
    const float squared = first * first + second * second;
    const float bounded = squared < kUnseen ? squared : kUnseen;
    result[i] = depth > kNearestDepth ? bounded : kUnseen;
  }
}

HELICAL_VECTOR_CLONES
void multiplyBall(const Block& block, const Target& target, float floor_share, float* product) {
  alignas(64) std::array<float, kBlock> squared;
  squaredDistances(block, target, squared.data());
  for (std::size_t i = 0; i < kBlock; ++i) product[i] *= expOfNegative(-0.5F * squared[i]) + floor_share;
}

HELICAL_VECTOR_CLONES
void addBall(const Block& block, const Target& target, float* sum) {
  alignas(64) std::array<float, kBlock> squared;
  squaredDistances(block, target, squared.data());
  for (std::size_t i = 0; i < kBlock; ++i) sum[i] += squared[i];
}

/// Adds the product's logarithm and starts the next product.
HELICAL_VECTOR_CLONES
void takeLogarithm(float* product, float* result, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    result[i] += logOfPositive(product[i]);
    product[i] = 1.0F;
  }
}

HELICAL_VECTOR_CLONES
void addFloor(float* sum, float floor_share, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) sum[i] = expOfNegative(-0.5F * sum[i]) + floor_share;
}

void perMarker(const Block& block, std::span<const BearingTarget> targets, double floor, float* result) {
  std::array<float, kBlock> product;
  product.fill(1.0F);
  for (std::size_t t = 0; t < targets.size(); ++t) {
    multiplyBall(block, Target(targets[t]), floorShare(targets[t], floor), product.data());
    if ((t + 1) % kFactors == 0 || t + 1 == targets.size())
      takeLogarithm(product.data(), result, block.count);
  }
}

void perCamera(const Block& block, std::span<const BearingTarget> targets, double floor, float* result) {
  if (targets.empty()) return;
  std::array<float, kBlock> sum{};
  for (const BearingTarget& target : targets) addBall(block, Target(target), sum.data());
  addFloor(sum.data(), floorShare(targets.back(), floor), block.count);
  takeLogarithm(sum.data(), result, block.count);
}

}  // namespace

void logLikelihoods(const ParticleCloud& cloud, std::span<const BearingTarget> targets, double floor,
                    LikelihoodProduct product, std::span<float> result) {
  std::fill(result.begin(), result.end(), 0.0F);
  for (std::size_t start = 0; start < result.size(); start += kBlock) {
    Block block;
    block.count = std::min(kBlock, result.size() - start);
    for (int row = 0; row < 12; ++row)
      block.pose[static_cast<std::size_t>(row)] = cloud.column(row).data() + start;
    (product == LikelihoodProduct::kPerMarker ? perMarker : perCamera)(block, targets, floor,
                                                                       result.data() + start);
  }
}

}  // namespace helical
