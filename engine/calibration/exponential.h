#pragma once

#include <bit>
#include <cstdint>

namespace helical {

/// exp(x) for x <= 0, 0 below -700: relative error below 1e-11. No branches and no calls, so that loops over
/// particles use the machine's vectors; the same bits on every machine.
inline double expOfNegative(double x) {
  constexpr double kLog2E = 1.4426950408889634;
  constexpr double kLn2High = 0.693147180369123816490;
  constexpr double kLn2Low = 1.90821492927058770002e-10;
  constexpr double kRound = 6755399441055744.0;  // adding it leaves the nearest integer in the low bits
  const double clamped = x < -700.0 ? -700.0 : x;
  const double shifted = clamped * kLog2E + kRound;
  const double integer = shifted - kRound;
  const double r = (clamped - integer * kLn2High) - integer * kLn2Low;
  double p = 1.0 / 3628800.0;
  p = p * r + 1.0 / 362880.0;
  p = p * r + 1.0 / 40320.0;
  p = p * r + 1.0 / 5040.0;
  p = p * r + 1.0 / 720.0;
  p = p * r + 1.0 / 120.0;
  p = p * r + 1.0 / 24.0;
  p = p * r + 1.0 / 6.0;
  p = p * r + 0.5;
  p = p * r + 1.0;
  p = p * r + 1.0;
  const auto exponent = (std::bit_cast<std::uint64_t>(shifted) + 1023) << 52;
  const double value = p * std::bit_cast<double>(exponent);
  return x < -700.0 ? 0.0 : value;
}

}  // namespace helical
