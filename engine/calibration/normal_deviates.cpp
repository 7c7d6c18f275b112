#include "engine/calibration/normal_deviates.h"

#include <algorithm>
#include <cmath>

namespace helical {
namespace {

using Words = std::array<std::uint32_t, kLanes>;
constexpr std::size_t kAtOnce = 2 * kLanes;

inline std::uint32_t rotated(std::uint32_t x, int by) {
  return (x << by) | (x >> (32 - by));
}

inline void draw(std::array<Words, 4>& state, Words& result) {
  for (std::size_t i = 0; i < kLanes; ++i) {
    std::uint32_t a = state[0][i], b = state[1][i], c = state[2][i], d = state[3][i];
    result[i] = rotated(a + d, 7) + a;
    const std::uint32_t t = b << 9;
    c ^= a;
    d ^= b;
    b ^= c;
    a ^= d;
    c ^= t;
    d = rotated(d, 11);
    state[0][i] = a;
    state[1][i] = b;
    state[2][i] = c;
    state[3][i] = d;
  }
}

/// Whole batches of kAtOnce.
HELICAL_VECTOR_CLONES
void fillBatches(std::array<Words, 4>& state, float* result, std::size_t batches) {
  Words radius_bits, turn_bits;
  for (std::size_t batch = 0; batch < batches; ++batch, result += kAtOnce) {
    draw(state, radius_bits);
    draw(state, turn_bits);
    for (std::size_t i = 0; i < kLanes; ++i) {
      const auto uniform =
          (static_cast<float>(static_cast<std::int32_t>(radius_bits[i] >> 9)) + 0.5F) * 0x1.0p-23F;
      const float radius = std::sqrt(-2.0F * logOfPositive(uniform));
      const CosineSine turn = cosineSineOfTurn(turn_bits[i]);
      result[i] = radius * turn.cosine;
      result[kLanes + i] = radius * turn.sine;
    }
  }
}

}  // namespace

NormalDeviates::NormalDeviates(std::uint64_t seed) {
  Random random(seed);
  for (Words& words : state_)
    for (std::uint32_t& word : words) word = static_cast<std::uint32_t>(random.bits() >> 32);
}

void NormalDeviates::fill(std::span<float> result) {
  const std::size_t batches = result.size() / kAtOnce;
  fillBatches(state_, result.data(), batches);
  const auto rest = result.subspan(batches * kAtOnce);
  if (rest.empty()) return;
  std::array<float, kAtOnce> last;
  fillBatches(state_, last.data(), 1);
  std::copy_n(last.begin(), rest.size(), rest.begin());
}

}  // namespace helical
