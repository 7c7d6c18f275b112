#include "engine/pipeline/white_board.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace helical {
namespace {

constexpr std::uint8_t kWhite = 235;

/// Where the polygon's edges cross row y, in ascending order.
struct Crossings {
  int count = 0;
  std::array<double, WhiteBoard::kMaxCorners> x{};
};

Crossings crossingsAt(const WhiteBoard& board, double y) {
  Crossings result;
  for (int i = 0, last = board.count - 1; i < board.count; last = i++) {
    const Eigen::Vector2d& a = board.corners[static_cast<std::size_t>(last)];
    const Eigen::Vector2d& b = board.corners[static_cast<std::size_t>(i)];
    if ((a.y() > y) == (b.y() > y)) continue;
    result.x[static_cast<std::size_t>(result.count++)] =
        a.x() + (y - a.y()) / (b.y() - a.y()) * (b.x() - a.x());
  }
  std::sort(result.x.begin(), result.x.begin() + result.count);
  return result;
}

}  // namespace

bool WhiteBoard::covers(const Eigen::Vector2d& pixel) const {
  const Crossings crossings = crossingsAt(*this, pixel.y());
  for (std::size_t i = 0; i + 1 < static_cast<std::size_t>(crossings.count); i += 2)
    if (pixel.x() >= crossings.x[i] && pixel.x() <= crossings.x[i + 1]) return true;
  return false;
}

bool WhiteBoards::covers(const Eigen::Vector2d& pixel) const {
  return std::any_of(boards.begin(), boards.begin() + count,
                     [&](const WhiteBoard& board) { return board.covers(pixel); });
}

void paintBoard(const WhiteBoard& board, const ImageView& image, std::uint8_t* pixels) {
  const int bytes = bytesPerPixel(image.format);
  for (int y = 0; y < image.height; ++y) {
    const Crossings crossings = crossingsAt(board, y);
    std::uint8_t* row = pixels + static_cast<std::ptrdiff_t>(y) * image.stride;
    for (std::size_t i = 0; i + 1 < static_cast<std::size_t>(crossings.count); i += 2) {
      const double left = std::max(0.0, std::ceil(crossings.x[i]));
      const double right = std::min(image.width - 1.0, std::floor(crossings.x[i + 1]));
      if (left > right) continue;
      std::memset(row + bytes * static_cast<int>(left), kWhite,
                  static_cast<std::size_t>(bytes) * static_cast<std::size_t>(right - left + 1.0));
    }
  }
}

}  // namespace helical
