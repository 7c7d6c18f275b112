#include "engine/calibration/intrinsics/board.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/aruco/charuco.hpp>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "engine/base/error.h"
#include "engine/base/require.h"

namespace helical {
namespace {

constexpr int kFewestCharucoCorners = 6;
constexpr int kLargestSide = 100;
constexpr int kLargestWindow = 11;    // px to either side of a corner
constexpr double kWindowShare = 0.3;  // of the distance to the next corner

constexpr std::array kDictionaries = {std::pair("DICT_4X4_50", cv::aruco::DICT_4X4_50),
                                      std::pair("DICT_4X4_100", cv::aruco::DICT_4X4_100),
                                      std::pair("DICT_4X4_250", cv::aruco::DICT_4X4_250),
                                      std::pair("DICT_4X4_1000", cv::aruco::DICT_4X4_1000),
                                      std::pair("DICT_5X5_50", cv::aruco::DICT_5X5_50),
                                      std::pair("DICT_5X5_100", cv::aruco::DICT_5X5_100),
                                      std::pair("DICT_5X5_250", cv::aruco::DICT_5X5_250),
                                      std::pair("DICT_5X5_1000", cv::aruco::DICT_5X5_1000),
                                      std::pair("DICT_6X6_50", cv::aruco::DICT_6X6_50),
                                      std::pair("DICT_6X6_100", cv::aruco::DICT_6X6_100),
                                      std::pair("DICT_6X6_250", cv::aruco::DICT_6X6_250),
                                      std::pair("DICT_6X6_1000", cv::aruco::DICT_6X6_1000),
                                      std::pair("DICT_7X7_50", cv::aruco::DICT_7X7_50),
                                      std::pair("DICT_7X7_100", cv::aruco::DICT_7X7_100),
                                      std::pair("DICT_7X7_250", cv::aruco::DICT_7X7_250),
                                      std::pair("DICT_7X7_1000", cv::aruco::DICT_7X7_1000),
                                      std::pair("DICT_ARUCO_ORIGINAL", cv::aruco::DICT_ARUCO_ORIGINAL)};

cv::aruco::PREDEFINED_DICTIONARY_NAME dictionaryOf(const std::string& name) {
  std::string known;
  for (const auto& [text, value] : kDictionaries) {
    if (name == text) return value;
    known += known.empty() ? text : std::string(", ") + text;
  }
  throw Error(ErrorKind::kInput, "unknown ArUco dictionary '" + name + "'", "--charuco",
              "use one of " + known);
}

/// A window that stays well away from the next corner in any direction: one that touches it is off by pixels.
int windowFor(const std::vector<cv::Point2f>& corners, std::size_t columns) {
  double nearest = 1e9;
  for (std::size_t i = 1; i < corners.size(); ++i) {
    if (i % columns != 0) nearest = std::min(nearest, cv::norm(corners[i] - corners[i - 1]));
    if (i >= columns) nearest = std::min(nearest, cv::norm(corners[i] - corners[i - columns]));
  }
  return std::clamp(static_cast<int>(kWindowShare * nearest), 2, kLargestWindow);
}

BoardView findChessboard(const cv::Mat& image, const Board& board) {
  BoardView view;
  const cv::Size size(board.columns, board.rows);
  std::vector<cv::Point2f> corners;
  if (!cv::findChessboardCorners(
          image, size, corners,
          cv::CALIB_CB_ADAPTIVE_THRESH | cv::CALIB_CB_NORMALIZE_IMAGE | cv::CALIB_CB_FAST_CHECK) &&
      !cv::findChessboardCornersSB(image, size, corners, cv::CALIB_CB_NORMALIZE_IMAGE))
    return view;
  const int window = windowFor(corners, static_cast<std::size_t>(board.columns));
  cv::cornerSubPix(image, corners, cv::Size(window, window), cv::Size(-1, -1),
                   cv::TermCriteria(cv::TermCriteria::EPS | cv::TermCriteria::COUNT, 50, 1e-3));
  for (int i = 0; i < board.rows * board.columns; ++i) {
    const cv::Point2f& c = corners[static_cast<std::size_t>(i)];
    view.pixels.emplace_back(c.x, c.y);
    view.on_board.emplace_back((i % board.columns) * board.square_m, (i / board.columns) * board.square_m,
                               0.0);
  }
  return view;
}

BoardView findCharuco(const cv::Mat& image, const Board& board) {
  BoardView view;
  const auto dictionary = cv::aruco::getPredefinedDictionary(dictionaryOf(board.dictionary));
  const auto charuco =
      cv::aruco::CharucoBoard::create(board.columns, board.rows, static_cast<float>(board.square_m),
                                      static_cast<float>(board.marker_m), dictionary);
  std::vector<std::vector<cv::Point2f>> markers;
  std::vector<int> ids, corner_ids;
  std::vector<cv::Point2f> corners;
  cv::aruco::detectMarkers(image, dictionary, markers, ids);
  if (ids.empty()) return view;
  cv::aruco::interpolateCornersCharuco(markers, ids, image, charuco, corners, corner_ids);
  if (corners.size() < kFewestCharucoCorners) return view;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const cv::Point3f& p = charuco->chessboardCorners[static_cast<std::size_t>(corner_ids[i])];
    view.pixels.emplace_back(corners[i].x, corners[i].y);
    view.on_board.emplace_back(p.x, p.y, 0.0);
  }
  return view;
}

/// Corners on one line tell nothing of the board's tilt.
bool onOneLine(const std::vector<Eigen::Vector3d>& points) {
  for (std::size_t i = 1; i < points.size(); ++i)
    for (std::size_t j = i + 1; j < points.size(); ++j) {
      const Eigen::Vector3d a = points[i] - points[0], b = points[j] - points[0];
      if (a.cross(b).norm() > 0.1 * a.norm() * b.norm()) return false;
    }
  return true;
}

}  // namespace

void validate(const Board& board) {
  requirePositive(board.square_m, "square");
  const int fewest = board.dictionary.empty() ? 3 : 2;
  if (board.columns < fewest || board.rows < fewest || board.columns > kLargestSide ||
      board.rows > kLargestSide)
    throw Error(
        ErrorKind::kInput,
        "a board of " + std::to_string(board.columns) + "x" + std::to_string(board.rows) + " cannot be found",
        "--board", "count its inner corners (ChArUco: squares), from 3x3 to 100x100");
  if (board.dictionary.empty()) return;
  dictionaryOf(board.dictionary);
  if (!(board.marker_m > 0.0 && board.marker_m < board.square_m))
    throw Error(ErrorKind::kInput, "the markers are not smaller than the squares", "--charuco",
                "give the marker's side in metres, less than --square");
}

BoardView findBoard(const GrayImage& image, const Board& board, const std::string& name) {
  const cv::Mat gray(image.height, image.width, CV_8UC1, const_cast<std::uint8_t*>(image.pixels),
                     image.stride);
  BoardView view;
  if (board.dictionary.empty()) {
    view = findChessboard(gray, board);
  } else {
    view = findCharuco(gray, board);
    if (view.pixels.empty()) {  // printed white on black?
      cv::Mat inverted;
      cv::bitwise_not(gray, inverted);
      view = findCharuco(inverted, board);
    }
    if (onOneLine(view.on_board)) view = {};
  }
  view.name = name;
  return view;
}

}  // namespace helical
