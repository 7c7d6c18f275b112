#pragma once

#include <vector>

#include "engine/base/random.h"
#include "tests/markers/scenes.h"

namespace helical::test {

/// A green ball before a grey wall; `shading` is the share of directed light.
struct BallPicture {
  double x = 20.0;
  double y = 20.0;
  double radius = 5.0;
  double shading = 0.5;
  double hidden_from = 1e9;  ///< from so far from its centre on, something dark is before it
  double hidden_side = 0.0;  ///< in this direction: 0 is to the right [rad]
  double way_x = 0.0;        ///< by which it moves while the shutter is open; `x`, `y` is the middle of it
  double way_y = 0.0;
  int side = 41;  ///< of the picture
};

/// Light without noise, blue, green and red of a pixel after each other: means of 16 x 16 samples, and of
/// moments half a pixel apart along the ball's way.
std::vector<double> lightOf(const BallPicture& ball);
/// A camera's picture of that light.
Picture exposed(const std::vector<double>& light, int side, double noise, Random& random);
/// Both.
Picture drawBall(const BallPicture& ball, double noise, Random& random);

}  // namespace helical::test
