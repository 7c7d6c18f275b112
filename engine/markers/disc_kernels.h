#pragma once

#include <array>
#include <cstddef>

namespace helical {

/// The parameters of DiscFit's model, in the order of its slopes; then those of an edge before the ball,
/// of its motion, or of the moments of a short one.
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
  kSmearParameters,
  kSpreadXX = kDiscParameters,
  kSpreadXY,
  kSpreadYY,
  kSpreadParameters
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

/// A second picture of the same disc, cell for cell: its light is that much brighter, before a level of its
/// own.
struct SecondPicture {
  float ratio = 1.0F;
  float around = 0.0F;
};
/// The parameters of a second picture's model: the disc's, with the level around it being the picture's own,
/// and the ratio.
inline constexpr int kSecondRatio = kDiscParameters, kSecondParameters = kSecondRatio + 1;

/// Over the given cells.
struct DiscSums {
  std::array<std::array<double, kCutParameters>, kCutParameters> normal;  ///< lower triangle
  std::array<double, kCutParameters> gradient;
  double count;
  double squares;
};

using DiscValues = std::array<float, kDiscParameters>;

/// Each fills residual and cover and gives the sums of the residuals and their slopes by the parameters.
/// No surface is darker than by ambient light alone, if there is directed light to speak of.
void measureDisc(const DiscValues& disc, DiscCells& cells, DiscSums& sums);
/// Of two pictures of it, whose cells are the same; the second's only `value` and `given` are read.
void measureTwo(const DiscValues& disc, const SecondPicture& picture, DiscCells& first, DiscCells& second,
                DiscSums& first_sums, DiscSums& second_sums);
/// With an edge before the disc; `cover` is what is seen.
void measureCutDisc(const DiscValues& disc, const CutEdge& edge, DiscCells& cells, DiscSums& sums);
/// The same as measureDisc, and the slopes by what a short motion would add: by second moments of the places
/// where the disc's centre was.
void measureSpreadDisc(const DiscValues& disc, DiscCells& cells, DiscSums& sums);
/// Of a disc that moved.
void measureSmearedDisc(const DiscValues& disc, const DiscMotion& motion, DiscCells& cells, DiscSums& sums);

// The same bits in every instruction set: no operation is fused, approximated or done in another order.
// Cells all of which a disc covers, or none, take less: those that stand together in the arrays should be
// alike.

}  // namespace helical
