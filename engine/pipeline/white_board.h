#pragma once

#include <Eigen/Core>
#include <array>

#include "engine/cameras/frame.h"

namespace helical {

/// A white board before a camera, as the camera sees it: a polygon of at least three corners in its image
/// [px]. What is behind it nobody sees.
struct WhiteBoard {
  static constexpr int kMaxCorners = 32;

  int count = 0;
  std::array<Eigen::Vector2d, kMaxCorners> corners{};

  bool covers(const Eigen::Vector2d& pixel) const;
};

/// All boards before one camera.
struct WhiteBoards {
  static constexpr int kMax = 4;

  int count = 0;
  std::array<WhiteBoard, kMax> boards{};

  bool covers(const Eigen::Vector2d& pixel) const;
};

/// Whitens the pixels that the board covers. `pixels` are those of `image`, which only says their layout.
void paintBoard(const WhiteBoard& board, const ImageView& image, std::uint8_t* pixels);

}  // namespace helical
