#include "engine/simulator/scene_noise.h"

#include <algorithm>
#include <cmath>

#include "engine/base/check.h"

namespace helical {
namespace {

constexpr std::size_t kPoolSize = 1U << 17;

}  // namespace

SceneNoise::SceneNoise(Random random, double sigma_levels) : random_(random), pool_(kPoolSize) {
  for (auto& value : pool_)
    value = static_cast<std::int16_t>(
        std::clamp(std::lround(random_.normal() * sigma_levels * kUnitsPerLevel), -16000L, 16000L));
}

const std::int16_t* SceneNoise::stretch(int count) {
  HELICAL_CHECK(count <= 65536);
  return pool_.data() + random_.bits() % (kPoolSize - static_cast<std::size_t>(count));
}

}  // namespace helical
