#include "ui/picture_viewport.h"

#include <gtest/gtest.h>

namespace helical {
namespace {

PictureViewport viewport(QSize sensor = {640, 480}, QSize room = {400, 400}) {
  PictureViewport result;
  result.setSensor(sensor);
  result.setRoom(room);
  return result;
}

void expectNear(const QPointF& a, const QPointF& b, double tolerance) {
  EXPECT_NEAR(a.x(), b.x(), tolerance);
  EXPECT_NEAR(a.y(), b.y(), tolerance);
}

TEST(PictureViewport, ShowsAllOfItInTheMiddle) {
  const PictureViewport view = viewport();
  EXPECT_EQ(view.area(), QRect(0, 50, 400, 300));
  EXPECT_FALSE(view.zoomed());
  expectNear(view.toWidget({-0.5, -0.5}), {0.0, 50.0}, 1e-9);
  expectNear(view.toWidget({639.5, 479.5}), {400.0, 350.0}, 1e-9);
}

TEST(PictureViewport, ToImageIsTheInverse) {
  PictureViewport view = viewport();
  view.zoomAt({120.0, 160.0}, 5.0);
  view.pan({-7.0, 11.0});
  const Eigen::Vector2d pixel(312.25, 201.5);
  EXPECT_LT((view.toImage(view.toWidget(pixel)) - pixel).norm(), 1e-9);
}

TEST(PictureViewport, WhatIsUnderTheMouseStaysThere) {
  PictureViewport view = viewport();
  const QPointF mouse(250.0, 170.0);
  const Eigen::Vector2d before = view.toImage(mouse);
  view.zoomAt(mouse, 3.0);
  EXPECT_DOUBLE_EQ(view.zoom(), 3.0);
  EXPECT_LT((view.toImage(mouse) - before).norm(), 1e-9);
  view.zoomAt(mouse, 1.7);
  EXPECT_LT((view.toImage(mouse) - before).norm(), 1e-9);
}

TEST(PictureViewport, NeverShowsWhatIsOutsideOfTheImage) {
  PictureViewport view = viewport();
  view.zoomAt({399.0, 349.0}, 4.0);
  for (const QPointF by : {QPointF(5000, 0), QPointF(-9000, -9000), QPointF(0, 9000)}) {
    view.pan(by);
    EXPECT_GE(view.visible().left(), 0.0);
    EXPECT_GE(view.visible().top(), 0.0);
    EXPECT_LE(view.visible().right(), 640.0 + 1e-9);
    EXPECT_LE(view.visible().bottom(), 480.0 + 1e-9);
  }
  view.zoomAt({10.0, 60.0}, 1e-3);
  EXPECT_EQ(view.visible(), QRectF(0, 0, 640, 480));
}

TEST(PictureViewport, ZoomHasAnEndAndAWayBack) {
  PictureViewport view = viewport();
  for (int i = 0; i < 50; ++i) view.zoomAt({100.0, 100.0}, 2.0);
  EXPECT_DOUBLE_EQ(view.zoom(), PictureViewport::kLargestZoom);
  view.reset();
  EXPECT_FALSE(view.zoomed());
  EXPECT_EQ(view.visible(), QRectF(0, 0, 640, 480));
}

TEST(PictureViewport, PanFollowsTheMouse) {
  PictureViewport view = viewport();
  view.zoomAt({200.0, 200.0}, 4.0);
  const Eigen::Vector2d pixel = view.toImage({200.0, 200.0});
  view.pan({12.0, -8.0});
  expectNear(view.toWidget(pixel), {212.0, 192.0}, 1e-9);
}

}  // namespace
}  // namespace helical
