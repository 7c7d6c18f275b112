#pragma once

#include <array>
#include <cstddef>

namespace helical {

/// The parameters of DiscFit's model, in the order of its slopes.
enum DiscParameter {
  kDiscX,
  kDiscY,
  kDiscRadius,
  kDiscAmbient,
  kDiscLightX,
  kDiscLightY,
  kDiscLightZ,
  kDiscAround,
  kDiscParameters
};

inline constexpr std::size_t kDiscCells = 8192;  ///< room for this many cells
inline constexpr std::size_t kDiscLanes =
    16;  ///< cells come in multiples of this, filled up with what is not given

/// Cells of a picture and what the model says of them, one array for each quantity.
struct DiscCells {
  std::size_t count = 0;  ///< a multiple of kDiscLanes
  alignas(64) std::array<float, kDiscCells> x;
  alignas(64) std::array<float, kDiscCells> y;
  alignas(64) std::array<float, kDiscCells> value;
  alignas(64) std::array<float, kDiscCells> given;  ///< 1, or 0 for what is not fitted
  alignas(64) std::array<float, kDiscCells> residual;
  alignas(64) std::array<float, kDiscCells> cover;
  alignas(64) std::array<std::array<float, kDiscCells>, kDiscParameters> slope;
};

struct DiscSums {
  std::array<std::array<double, kDiscParameters>, kDiscParameters> normal;  ///< lower triangle
  std::array<double, kDiscParameters> gradient;
  double count;
  double squares;
};

/// Fills residual, cover and slope. `with_shadow`: no surface is darker than by ambient light alone.
void evaluateDisc(const std::array<float, kDiscParameters>& parameters, bool with_shadow, DiscCells& cells);
/// Over the given cells.
void sumDisc(const DiscCells& cells, DiscSums& sums);

// The same bits in every instruction set: no operation is fused, approximated or done in another order.

}  // namespace helical
