#pragma once

#include <Eigen/Core>

#include "engine/pipeline/white_board.h"

namespace helical {

/// Draws, drags and removes the white boards before one camera. Positions are pixels of its image; `reach` is
/// how far from a handle a press still means it [px]. A plain value; no drawing.
class BoardEditor {
 public:
  enum class Tool { kNone, kRectangle, kFreeHand };

  void setTool(Tool tool) { tool_ = tool; }
  Tool tool() const { return tool_; }

  /// A press on a handle removes its board, one on a board takes hold of it, one elsewhere begins a new board
  /// with the tool. False if it means nothing here.
  bool press(const Eigen::Vector2d& pixel, double reach);
  void move(const Eigen::Vector2d& pixel);
  /// Ends what the press began. The tool is put down after a board.
  void release();
  void clear();

  /// True once after every change of `boards`.
  bool takeChange();
  const WhiteBoards& boards() const { return boards_; }
  /// The board that is being drawn; empty if none is.
  const WhiteBoard& draft() const { return draft_; }
  bool wouldGrab(const Eigen::Vector2d& pixel, double reach) const;

  /// Where a board's handle for removal is: its corner nearest to the image's top right.
  static Eigen::Vector2d handle(const WhiteBoard& board);

 private:
  int boardAt(const Eigen::Vector2d& pixel) const;
  int handleAt(const Eigen::Vector2d& pixel, double reach) const;
  void remove(int board);

  Tool tool_ = Tool::kNone;
  WhiteBoards boards_;
  WhiteBoard draft_;
  bool drawing_ = false;
  double stroke_step_ = 0.0;  ///< px between the corners of a free-hand board
  int grabbed_ = -1;
  Eigen::Vector2d last_ = Eigen::Vector2d::Zero();
  bool changed_ = false;
};

}  // namespace helical
