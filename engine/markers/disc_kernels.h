#pragma once

#include <array>
#include <cstddef>

namespace helical {

/// The parameters of DiscFit's model, in the order of its slopes; then those of an edge before the ball,
/// or of its motion.
enum DiscParameter {
  kDiscX,
  kDiscY,
  kDiscRadius,
  kDiscAmbient,
  kDiscLightX,
  kDiscLightY,
  kDiscLightZ,
  kDiscAround,
  kDiscParameters,
  kCutOffset = kDiscParameters,
  kCutTurn,
  kCutLevel,
  kCutParameters,
  kSmearHalfX = kDiscParameters,
  kSmearHalfY,
  kSmearParameters
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
  alignas(64) std::array<std::array<float, kDiscCells>, kCutParameters> slope;
};

/// The straight edge of something before the ball: what lies beyond, seen from a place along the normal, is
/// hidden and shows its level instead.
struct CutEdge {
  float x = 0.0F, y = 0.0F;  ///< the place
  float normal_x = 1.0F, normal_y = 0.0F;
  float offset = 0.0F;  ///< from the place
  float level = 0.0F;
};

/// The way of a ball that moved evenly while the shutter was open: from its middle, where the disc's centre
/// stands, by a half of it back and forth. Taken at that many moments.
struct DiscMotion {
  float half_x = 0.0F, half_y = 0.0F;
  int moments = 1;
};

struct DiscSums {
  std::array<std::array<double, kCutParameters>, kCutParameters> normal;  ///< lower triangle
  std::array<double, kCutParameters> gradient;
  double count;
  double squares;
};

/// Fills residual, cover and slope. `with_shadow`: no surface is darker than by ambient light alone.
void evaluateDisc(const std::array<float, kDiscParameters>& parameters, bool with_shadow, DiscCells& cells);
/// After evaluateDisc: the same with an edge before the disc, and the edge's slopes. `cover` is what is seen.
void cutDisc(const CutEdge& edge, DiscCells& cells);
/// As evaluateDisc, of a disc that moved, and the motion's slopes.
void smearDisc(const std::array<float, kDiscParameters>& parameters, bool with_shadow,
               const DiscMotion& motion, DiscCells& cells);
/// Over the given cells, of the disc's parameters alone, or of the edge's or the motion's, too.
void sumDisc(const DiscCells& cells, DiscSums& sums);
void sumCutDisc(const DiscCells& cells, DiscSums& sums);
void sumSmearedDisc(const DiscCells& cells, DiscSums& sums);

// The same bits in every instruction set: no operation is fused, approximated or done in another order.

}  // namespace helical
