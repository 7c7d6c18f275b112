#include "ui/scene_labels.h"

#include <gtest/gtest.h>

namespace helical {
namespace {

const QSizeF kName(60.0, 16.0);

TEST(SceneLabels, StandWhereTheyBelongWhenThereIsRoom) {
  const std::vector<QPointF> anchors{{100, 100}, {100, 130}, {180, 100}};
  const auto boxes = placeLabels(anchors, {kName, kName, kName});
  for (std::size_t i = 0; i < anchors.size(); ++i) EXPECT_EQ(boxes[i].center(), anchors[i]);
}

TEST(SceneLabels, MakeRoomForThoseBeforeThem) {
  const std::vector<QPointF> anchors{{100, 100}, {104, 101}, {98, 99}, {120, 104}, {100, 100}};
  const auto boxes = placeLabels(anchors, std::vector<QSizeF>(anchors.size(), kName));
  EXPECT_EQ(boxes.front().center(), anchors.front());
  for (std::size_t i = 0; i < boxes.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) EXPECT_FALSE(boxes[i].intersects(boxes[j])) << i << " over " << j;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    EXPECT_EQ(boxes[i].center().x(), anchors[i].x());
    EXPECT_LE(std::abs(boxes[i].center().y() - anchors[i].y()), 4 * kName.height());
  }
}

TEST(SceneLabels, ACrowdWithoutRoomStaysAtItsPlaces) {
  const std::vector<QPointF> anchors(40, QPointF(100, 100));
  const auto boxes = placeLabels(anchors, std::vector<QSizeF>(anchors.size(), kName));
  EXPECT_EQ(boxes.back().center(), anchors.back());
}

}  // namespace
}  // namespace helical
