#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "ui/picture_scaler.h"

namespace helical {
namespace {

constexpr int kWidth = 320, kHeight = 240;

/// A grey room with a shaded ball of this hue in the middle.
CameraPicture pictureOfBall(int hue) {
  CameraPicture picture;
  picture.width = kWidth;
  picture.height = kHeight;
  picture.bgr.assign(3 * kWidth * kHeight, 90);
  cv::Mat bgr(kHeight, kWidth, CV_8UC3, picture.bgr.data());
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const double r = std::hypot(x - 160.0, y - 120.0) / 14.0;
      if (r >= 1.0) continue;
      const double light = 0.55 + 0.45 * std::sqrt(1.0 - r * r);
      const cv::Mat hsv(1, 1, CV_8UC3, cv::Scalar(hue, 190, 230 * light));
      cv::Mat pixel;
      cv::cvtColor(hsv, pixel, cv::COLOR_HSV2BGR);
      bgr.at<cv::Vec3b>(y, x) = pixel.at<cv::Vec3b>(0, 0);
    }
  return picture;
}

bool holds(const ColourRange& range, int hue) {
  return range.hue_low <= range.hue_high ? hue >= range.hue_low && hue <= range.hue_high
                                         : hue >= range.hue_low || hue <= range.hue_high;
}

TEST(ColourOfBall, HoldsTheBallAndNotItsOpposite) {
  for (const int hue : {0, 3, 30, 60, 120, 177}) {
    ColourRange range;
    ASSERT_TRUE(colourOfBall(pictureOfBall(hue), {160.0, 120.0}, range)) << hue;
    EXPECT_TRUE(holds(range, hue)) << hue << ": " << range.hue_low << " to " << range.hue_high;
    EXPECT_FALSE(holds(range, (hue + 90) % 180)) << hue;
    EXPECT_FALSE(holds(range, (hue + 25) % 180)) << hue;
    EXPECT_LT(range.saturation_low, 190);
    EXPECT_LT(range.value_low, 140);
    EXPECT_EQ(range.saturation_high, 255);
  }
}

TEST(ColourOfBall, FromItsRimToo) {
  ColourRange middle, rim;
  const CameraPicture picture = pictureOfBall(60);
  ASSERT_TRUE(colourOfBall(picture, {160.0, 120.0}, middle));
  ASSERT_TRUE(colourOfBall(picture, {168.0, 112.0}, rim));
  EXPECT_NEAR(middle.hue_low, rim.hue_low, 3);
  EXPECT_NEAR(middle.value_low, rim.value_low, 15);
}

TEST(ColourOfBall, GreyNothingAndOutsideAreNoColour) {
  const ColourRange before;
  ColourRange range = before;
  const CameraPicture picture = pictureOfBall(60);
  EXPECT_FALSE(colourOfBall(picture, {20.0, 20.0}, range));
  EXPECT_FALSE(colourOfBall(picture, {-3.0, 20.0}, range));
  EXPECT_FALSE(colourOfBall(picture, {20.0, 240.0}, range));
  EXPECT_FALSE(colourOfBall(CameraPicture{}, {0.0, 0.0}, range));
  EXPECT_EQ(range, before);
}

PictureViewport viewport(double zoom) {
  PictureViewport result;
  result.setSensor({kWidth, kHeight});
  result.setRoom({kWidth, kHeight});
  if (zoom > 1.0) result.zoomAt({160.5, 120.5}, zoom);
  return result;
}

TEST(ScalePicture, ZoomedPixelsStandWhereTheViewportSays) {
  CameraPicture picture = pictureOfBall(60);
  std::uint8_t* dot = picture.bgr.data() + 3 * (112 * kWidth + 150);
  dot[0] = dot[1] = dot[2] = 255;
  for (const double zoom : {1.0, 4.0, 9.0}) {
    const PictureViewport view = viewport(zoom);
    QImage image;
    scalePicture(picture, view, {}, 1.0, image);
    ASSERT_EQ(image.size(), QSize(kWidth, kHeight));
    const QPointF at = view.toWidget({150.0, 112.0});
    EXPECT_GT(qGray(image.pixel(static_cast<int>(at.x()), static_cast<int>(at.y()))), 220) << zoom;
  }
}

TEST(ScalePicture, MasksTintTheColourAndDarkenTheBackground) {
  CameraPicture picture = pictureOfBall(60);
  picture.background = std::make_shared<const std::vector<std::uint8_t>>(picture.bgr.size(), 90);
  PictureMasks masks;
  masks.colour = true;
  masks.range = ColourRange{50, 70, 80, 255, 40, 255};
  QImage image;
  scalePicture(picture, viewport(1.0), masks, 1.0, image);
  const QColor ball = image.pixelColor(160, 120), room = image.pixelColor(30, 30);
  EXPECT_GT(ball.red(), ball.green()) << "tinted";
  EXPECT_EQ(room, QColor(90, 90, 90));
  masks.background = true;
  scalePicture(picture, viewport(1.0), masks, 1.0, image);
  EXPECT_LT(image.pixelColor(30, 30).lightness(), 60);
  EXPECT_EQ(image.pixelColor(160, 120), ball) << "the ball is no background";
}

}  // namespace
}  // namespace helical
