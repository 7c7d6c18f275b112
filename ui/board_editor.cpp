#include "ui/board_editor.h"

#include <algorithm>
#include <utility>

namespace helical {
namespace {

constexpr double kSmallestBoard = 8.0;  // px across: less is a slip of the hand
constexpr double kStrokeStep = 6.0;     // px between corners drawn by free hand

Eigen::Vector2d extentOf(const WhiteBoard& board) {
  Eigen::Vector2d low = board.corners[0], high = board.corners[0];
  for (int i = 1; i < board.count; ++i) {
    low = low.cwiseMin(board.corners[static_cast<std::size_t>(i)]);
    high = high.cwiseMax(board.corners[static_cast<std::size_t>(i)]);
  }
  return high - low;
}

void setRectangle(WhiteBoard& board, const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
  board.count = 4;
  board.corners[0] = from;
  board.corners[1] = {to.x(), from.y()};
  board.corners[2] = to;
  board.corners[3] = {from.x(), to.y()};
}

/// Every other corner goes, so that a long stroke still fits.
void thin(WhiteBoard& board) {
  int kept = 0;
  for (int i = 0; i < board.count; i += 2)
    board.corners[static_cast<std::size_t>(kept++)] = board.corners[static_cast<std::size_t>(i)];
  board.count = kept;
}

}  // namespace

Eigen::Vector2d BoardEditor::handle(const WhiteBoard& board) {
  const auto begin = board.corners.begin();
  return *std::max_element(begin, begin + board.count,
                           [](const auto& a, const auto& b) { return a.x() - a.y() < b.x() - b.y(); });
}

int BoardEditor::handleAt(const Eigen::Vector2d& pixel, double reach) const {
  for (int i = boards_.count - 1; i >= 0; --i)
    if ((handle(boards_.boards[static_cast<std::size_t>(i)]) - pixel).norm() <= reach) return i;
  return -1;
}

int BoardEditor::boardAt(const Eigen::Vector2d& pixel) const {
  for (int i = boards_.count - 1; i >= 0; --i)
    if (boards_.boards[static_cast<std::size_t>(i)].covers(pixel)) return i;
  return -1;
}

bool BoardEditor::wouldGrab(const Eigen::Vector2d& pixel, double reach) const {
  return handleAt(pixel, reach) >= 0 || boardAt(pixel) >= 0;
}

void BoardEditor::remove(int board) {
  const auto begin = boards_.boards.begin();
  std::move(begin + board + 1, begin + boards_.count, begin + board);
  --boards_.count;
  changed_ = true;
}

void BoardEditor::clear() {
  changed_ = changed_ || boards_.count > 0;
  boards_.count = 0;
  drawing_ = false;
  draft_.count = 0;
  grabbed_ = -1;
}

bool BoardEditor::press(const Eigen::Vector2d& pixel, double reach) {
  last_ = pixel;
  if (const int board = handleAt(pixel, reach); board >= 0) {
    remove(board);
    return true;
  }
  grabbed_ = boardAt(pixel);
  if (grabbed_ >= 0) return true;
  drawing_ = tool_ != Tool::kNone && boards_.count < WhiteBoards::kMax;
  draft_.count = 0;
  stroke_step_ = kStrokeStep;
  if (drawing_) draft_.corners[static_cast<std::size_t>(draft_.count++)] = pixel;
  return drawing_;
}

void BoardEditor::move(const Eigen::Vector2d& pixel) {
  if (grabbed_ >= 0) {
    WhiteBoard& board = boards_.boards[static_cast<std::size_t>(grabbed_)];
    for (int i = 0; i < board.count; ++i) board.corners[static_cast<std::size_t>(i)] += pixel - last_;
    last_ = pixel;
    changed_ = true;
  } else if (drawing_ && tool_ == Tool::kRectangle) {
    setRectangle(draft_, draft_.corners[0], pixel);
  } else if (drawing_) {
    const Eigen::Vector2d& end = draft_.corners[static_cast<std::size_t>(draft_.count - 1)];
    if ((pixel - end).norm() < stroke_step_) return;
    if (draft_.count == WhiteBoard::kMaxCorners) {
      thin(draft_);
      stroke_step_ *= 2.0;
    }
    draft_.corners[static_cast<std::size_t>(draft_.count++)] = pixel;
  }
}

void BoardEditor::release() {
  if (drawing_ && draft_.count >= 3 && extentOf(draft_).minCoeff() >= kSmallestBoard) {
    boards_.boards[static_cast<std::size_t>(boards_.count++)] = draft_;
    tool_ = Tool::kNone;
    changed_ = true;
  }
  drawing_ = false;
  draft_.count = 0;
  grabbed_ = -1;
}

bool BoardEditor::takeChange() {
  return std::exchange(changed_, false);
}

}  // namespace helical
