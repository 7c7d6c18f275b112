#include "ui/board_editor.h"

#include <gtest/gtest.h>

#include <cmath>

namespace helical {
namespace {

using Tool = BoardEditor::Tool;
constexpr double kReach = 10.0;

void drag(BoardEditor& editor, const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
  editor.press(from, kReach);
  editor.move(0.5 * (from + to));
  editor.move(to);
  editor.release();
}

BoardEditor withOneBoard() {
  BoardEditor editor;
  editor.setTool(Tool::kRectangle);
  drag(editor, {100, 100}, {200, 180});
  editor.takeChange();
  return editor;
}

TEST(BoardEditor, WithoutAToolADragOnTheImageMeansNothing) {
  BoardEditor editor;
  EXPECT_FALSE(editor.press({50, 50}, kReach));
  editor.move({150, 150});
  editor.release();
  EXPECT_EQ(editor.boards().count, 0);
  EXPECT_FALSE(editor.takeChange());
}

TEST(BoardEditor, ARectangleCoversWhatWasDraggedOverAndPutsTheToolDown) {
  BoardEditor editor;
  editor.setTool(Tool::kRectangle);
  drag(editor, {200, 180}, {100, 100});
  ASSERT_EQ(editor.boards().count, 1);
  EXPECT_TRUE(editor.boards().covers({150, 140}));
  EXPECT_FALSE(editor.boards().covers({150, 190}));
  EXPECT_FALSE(editor.boards().covers({90, 140}));
  EXPECT_EQ(editor.tool(), Tool::kNone);
  EXPECT_TRUE(editor.takeChange());
  EXPECT_FALSE(editor.takeChange());
}

TEST(BoardEditor, ASlipOfTheHandIsNoBoard) {
  BoardEditor editor;
  editor.setTool(Tool::kRectangle);
  drag(editor, {100, 100}, {103, 160});
  EXPECT_EQ(editor.boards().count, 0);
  EXPECT_EQ(editor.tool(), Tool::kRectangle) << "still to be drawn";
}

TEST(BoardEditor, ALongFreeHandStrokeIsOneBoardOfItsShape) {
  BoardEditor editor;
  editor.setTool(Tool::kFreeHand);
  const Eigen::Vector2d center(320, 240);
  const auto at = [&](double angle) -> Eigen::Vector2d {
    return center + 100.0 * Eigen::Vector2d(std::cos(angle), std::sin(angle));
  };
  editor.press(at(0.0), kReach);
  for (int i = 1; i <= 1000; ++i) editor.move(at(2.0 * M_PI * i / 1000.0));
  editor.release();
  ASSERT_EQ(editor.boards().count, 1);
  EXPECT_LE(editor.boards().boards[0].count, WhiteBoard::kMaxCorners);
  EXPECT_TRUE(editor.boards().covers(center));
  for (int i = 0; i < 12; ++i) {
    EXPECT_TRUE(editor.boards().covers(center + 0.8 * (at(0.5 * i) - center))) << i;
    EXPECT_FALSE(editor.boards().covers(center + 1.1 * (at(0.5 * i) - center))) << i;
  }
}

TEST(BoardEditor, ABoardIsDraggedByItsFace) {
  BoardEditor editor = withOneBoard();
  drag(editor, {150, 140}, {250, 300});
  EXPECT_TRUE(editor.takeChange());
  EXPECT_EQ(editor.boards().count, 1);
  EXPECT_FALSE(editor.boards().covers({150, 140}));
  EXPECT_TRUE(editor.boards().covers({250, 300}));
}

TEST(BoardEditor, ItsCrossRemovesItAndNoOther) {
  BoardEditor editor = withOneBoard();
  editor.setTool(Tool::kRectangle);
  drag(editor, {300, 300}, {400, 400});
  ASSERT_EQ(editor.boards().count, 2);
  const Eigen::Vector2d cross = BoardEditor::handle(editor.boards().boards[0]);
  EXPECT_EQ(cross, Eigen::Vector2d(200, 100));
  EXPECT_TRUE(editor.press(cross, kReach));
  editor.release();
  ASSERT_EQ(editor.boards().count, 1);
  EXPECT_TRUE(editor.boards().covers({350, 350}));
}

TEST(BoardEditor, ThereAreOnlySoManyBoards) {
  BoardEditor editor;
  for (int i = 0; i < WhiteBoards::kMax + 2; ++i) {
    editor.setTool(Tool::kRectangle);
    drag(editor, {60.0 * i, 10.0}, {60.0 * i + 40.0, 60.0});
  }
  EXPECT_EQ(editor.boards().count, WhiteBoards::kMax);
  editor.clear();
  EXPECT_EQ(editor.boards().count, 0);
}

}  // namespace
}  // namespace helical
