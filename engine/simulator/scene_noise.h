#pragma once

#include <cstdint>
#include <vector>

#include "engine/base/random.h"

namespace helical {

/// Sensor noise from a pool of normal deviates that is read from random places: drawing each pixel's own
/// would cost more than the rest of the picture. In 1/64 grey levels. One thread.
class SceneNoise {
 public:
  static constexpr int kUnitsPerLevel = 64;

  SceneNoise(Random random, double sigma_levels);

  /// `count` deviates in a row, from a random place of the pool; `count` at most 65536.
  const std::int16_t* stretch(int count);

 private:
  Random random_;
  std::vector<std::int16_t> pool_;
};

}  // namespace helical
