#include "engine/simulator/scene_board.h"

#include <algorithm>
#include <cmath>

namespace helical {

SceneBoard::SceneBoard(int width, int height, SceneNoise& noise) : width_(width), height_(height) {
  surface_.reserve(3U * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  for (int y = 0; y < height; ++y) {
    const std::int16_t* deviates = noise.stretch(3 * width);
    // Shaded along x only: rows can be exchanged to give each frame noise of its own.
    for (int i = 0; i < 3 * width; ++i) {
      const double shade = 226.0 + 12.0 * i / (3.0 * width) - (i % 3 == 0 ? 3.0 : 0.0);
      const double value = shade + static_cast<double>(deviates[i]) / SceneNoise::kUnitsPerLevel;
      surface_.push_back(static_cast<std::uint8_t>(std::clamp(std::lround(value), 0L, 255L)));
    }
  }
}

void SceneBoard::cover(double share, std::uint8_t* bgr, Random& random) const {
  const auto columns = static_cast<std::size_t>(std::lround(std::min(share, 1.0) * width_));
  const auto row_bytes = 3U * static_cast<std::size_t>(width_);
  const int shift = static_cast<int>(random.uniform(0.0, height_));
  constexpr std::size_t kEdge = 4;  ///< columns of shadow behind the board
  for (int y = 0; y < height_; ++y) {
    std::uint8_t* row = bgr + static_cast<std::size_t>(y) * row_bytes;
    const auto source_row = static_cast<std::size_t>((y + shift) % height_);
    std::copy_n(surface_.data() + source_row * row_bytes, 3 * columns, row);
    const std::size_t end = std::min(columns + kEdge, static_cast<std::size_t>(width_));
    for (std::size_t x = columns; x < end; ++x)
      for (std::size_t c = 0; c < 3; ++c)
        row[3 * x + c] = static_cast<std::uint8_t>(row[3 * x + c] * (x - columns + 1) / (kEdge + 1));
  }
}

}  // namespace helical
