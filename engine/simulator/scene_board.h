#pragma once

#include <cstdint>
#include <vector>

#include "engine/base/random.h"
#include "engine/simulator/scene_noise.h"

namespace helical {

/// A white board held before the lens. One thread.
class SceneBoard {
 public:
  SceneBoard(int width, int height, SceneNoise& noise);

  /// Covers the left `share` of a picture of packed BGR rows; more than 1 counts as 1.
  void cover(double share, std::uint8_t* bgr, Random& random) const;

 private:
  int width_;
  int height_;
  std::vector<std::uint8_t> surface_;  ///< with noise
};

}  // namespace helical
