#pragma once

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
};

/// 41 x 41 pixels, each the mean of 16 x 16 samples, with noise.
Picture drawBall(const BallPicture& ball, double noise, Random& random);

}  // namespace helical::test
