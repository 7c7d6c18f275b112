#pragma once

#include <array>
#include <cstdint>

namespace helical {

/// Random numbers that repeat for a seed on every machine and standard library: xoshiro256++ (Blackman and
/// Vigna, 2021), seeded by splitmix64; normal deviates by the polar method. One thread.
class Random {
 public:
  explicit Random(std::uint64_t seed);

  /// A generator of its own for a named part of a simulation, so that a draw added in one part leaves the
  /// others as they were.
  Random fork(std::uint64_t stream) const;

  std::uint64_t bits();
  double uniform();                         ///< [0, 1)
  double uniform(double low, double high);  ///< [low, high)
  double normal();                          ///< mean 0, standard deviation 1

 private:
  std::uint64_t seed_;
  std::array<std::uint64_t, 4> state_;
  double spare_ = 0.0;
  bool has_spare_ = false;
};

}  // namespace helical
