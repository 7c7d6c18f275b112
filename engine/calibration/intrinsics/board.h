#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace helical {

/// A calibration board. Chessboards are counted in inner corners, as OpenCV does; ChArUco boards in squares.
struct Board {
  int columns = 9, rows = 6;
  double square_m = 0.025;
  std::string dictionary;  ///< of ArUco markers, such as "DICT_4X4_50"; empty: a plain chessboard
  double marker_m = 0.0;   ///< side of a marker
};

void validate(const Board& board);  ///< throws Error(kInput)

/// An 8-bit image that somebody else owns.
struct GrayImage {
  const std::uint8_t* pixels = nullptr;
  int width = 0, height = 0;
  std::size_t stride = 0;  ///< bytes from row to row
};

/// The corners of a board that were found in one image; as many pixels as points.
struct BoardView {
  std::string name;  ///< of the image
  std::vector<Eigen::Vector2d> pixels;
  std::vector<Eigen::Vector3d> on_board;  ///< metres, z = 0
};

/// Finds the board's corners to a fraction of a pixel; empty when it is not there. Throws Error(kInput) for a
/// dictionary that does not exist.
BoardView findBoard(const GrayImage& image, const Board& board, const std::string& name);

}  // namespace helical
