#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "engine/base/random.h"
#include "engine/calibration/vector_math.h"

namespace helical {

/// Standard normal numbers by the thousand, up to 5.7 standard deviations: the method of Box and Muller
/// (1958) on kLanes generators xoshiro128++ (Blackman and Vigna 2021) side by side. Repeats for a seed on
/// every machine. One thread.
class NormalDeviates {
 public:
  explicit NormalDeviates(std::uint64_t seed);

  void fill(std::span<float> result);

 private:
  using Words = std::array<std::uint32_t, kLanes>;
  std::array<Words, 4> state_;
};

}  // namespace helical
