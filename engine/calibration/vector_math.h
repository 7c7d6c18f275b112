#pragma once

#include <bit>
#include <cstdint>

/// Before a function whose loops run over particles: compiled for AVX2 too and chosen when the program
/// starts. Same bits on every machine: no contraction, and sums in kLanes parts whatever the vectors' width.
/// Sanitizers cannot bear the start-up code.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__)
#define HELICAL_VECTOR_CLONES __attribute__((target_clones("default", "avx2")))
#else
#define HELICAL_VECTOR_CLONES
#endif

namespace helical {

/// Parts that a sum over particles is split into.
inline constexpr int kLanes = 16;

/// exp(x) for x <= 0, 0 below -87: relative error below 3e-7. Neither branches nor calls, as all functions
/// here, so that loops over particles use the machine's vectors; the same bits on every machine.
inline float expOfNegative(float x) {
  constexpr float kLog2E = 1.44269504F;
  constexpr float kLn2High = 0.693359375F;
  constexpr float kLn2Low = -2.12194440e-4F;
  constexpr float kRound = 12582912.0F;  // adding it leaves the nearest integer in the low bits
  const float clamped = x < -87.0F ? -87.0F : x;
  const float shifted = clamped * kLog2E + kRound;
  const float integer = shifted - kRound;
  const float r = (clamped - integer * kLn2High) - integer * kLn2Low;
  float p = 1.9875691500e-4F;
  p = p * r + 1.3981999507e-3F;
  p = p * r + 8.3334519073e-3F;
  p = p * r + 4.1665795894e-2F;
  p = p * r + 1.6666665459e-1F;
  p = p * r + 5.0000001201e-1F;
  p = p * (r * r) + r + 1.0F;
  const auto exponent = (std::bit_cast<std::uint32_t>(shifted) + 127U) << 23;
  const float value = p * std::bit_cast<float>(exponent);
  return x < -87.0F ? 0.0F : value;
}

/// Natural logarithm of a normal positive number: absolute error below 1e-7 or relative below 2e-7. The
/// polynomial is that of the Cephes library.
inline float logOfPositive(float x) {
  constexpr std::uint32_t kRootOfHalf = 0x3f3504f3U;
  const std::uint32_t shifted = std::bit_cast<std::uint32_t>(x) - kRootOfHalf;
  const auto exponent = static_cast<float>(static_cast<std::int32_t>(shifted) >> 23);
  const float m = std::bit_cast<float>((shifted & 0x007fffffU) + kRootOfHalf) - 1.0F;
  const float square = m * m;
  float p = 7.0376836292e-2F;
  p = p * m - 1.1514610310e-1F;
  p = p * m + 1.1676998740e-1F;
  p = p * m - 1.2420140846e-1F;
  p = p * m + 1.4249322787e-1F;
  p = p * m - 1.6668057665e-1F;
  p = p * m + 2.0000714765e-1F;
  p = p * m - 2.4999993993e-1F;
  p = p * m + 3.3333331174e-1F;
  const float tail = p * m * square - 2.12194440e-4F * exponent - 0.5F * square;
  return m + tail + 0.693359375F * exponent;
}

/// Cosine and sine of 2 pi times `bits` / 2^32: absolute error below 2e-7.
struct CosineSine {
  float cosine;
  float sine;
};
inline CosineSine cosineSineOfTurn(std::uint32_t bits) {
  // Quarter turns to the nearest, and what is left in [-pi/4, pi/4).
  const std::uint32_t shifted = bits + 0x20000000U;
  const std::uint32_t quarter = shifted >> 30;
  const auto rest = static_cast<std::int32_t>(shifted & 0x3fffffffU) - 0x20000000;
  const float x = static_cast<float>(rest) * 1.4629180792671596e-9F;  // 2 pi / 2^32
  const float square = x * x;
  const float s =
      x + x * square * ((-1.9515295891e-4F * square + 8.3321608736e-3F) * square - 1.6666654611e-1F);
  const float c =
      1.0F - 0.5F * square +
      square * square *
          ((2.443315711809948e-5F * square - 1.388731625493765e-3F) * square + 4.166664568298827e-2F);
  const bool swapped = (quarter & 1U) != 0U;
  const std::uint32_t cosine = std::bit_cast<std::uint32_t>(swapped ? s : c);
  const std::uint32_t sine = std::bit_cast<std::uint32_t>(swapped ? c : s);
  const std::uint32_t cosine_sign = ((quarter + 1U) & 2U) << 30;
  const std::uint32_t sine_sign = (quarter & 2U) << 30;
  return {std::bit_cast<float>(cosine ^ cosine_sign), std::bit_cast<float>(sine ^ sine_sign)};
}

}  // namespace helical
