#include "ui/picture_scaler.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace helical {
namespace {

constexpr int kReach = 40;     // px about the click that may belong to the ball
constexpr int kLikeness = 14;  // grey levels from one pixel to its neighbour
constexpr int kFewestPixels = 5;
constexpr int kGreySaturation = 50;  // below, a hue means nothing
constexpr int kHueMargin = 8, kSaturationMargin = 45, kValueMargin = 35;

cv::Mat matOf(const std::vector<std::uint8_t>& bgr, int width, int height) {
  return {height, width, CV_8UC3, const_cast<std::uint8_t*>(bgr.data())};
}

void resizeVisible(const cv::Mat& bgr, const PictureViewport& viewport, cv::Size size, cv::Mat& scaled) {
  const QRectF seen = viewport.visible();
  if (!viewport.zoomed()) {
    cv::resize(bgr, scaled, size, 0, 0, cv::INTER_LINEAR);
    return;
  }
  const double sx = seen.width() / size.width, sy = seen.height() / size.height;
  // From the target's pixel centres to the source's.
  const cv::Matx23d to_source(sx, 0.0, seen.left() + 0.5 * sx - 0.5, 0.0, sy, seen.top() + 0.5 * sy - 0.5);
  cv::warpAffine(bgr, scaled, to_source, size,
                 (sx < 0.5 ? cv::INTER_NEAREST : cv::INTER_LINEAR) | cv::WARP_INVERSE_MAP,
                 cv::BORDER_REPLICATE);
}

void colourMask(const cv::Mat& bgr, const ColourRange& range, cv::Mat& mask) {
  cv::Mat hsv;
  cv::cvtColor(bgr, hsv, cv::COLOR_BGR2HSV);
  const auto within = [&](int hue_low, int hue_high, cv::Mat& result) {
    cv::inRange(hsv, cv::Scalar(hue_low, range.saturation_low, range.value_low),
                cv::Scalar(hue_high, range.saturation_high, range.value_high), result);
  };
  if (range.hue_low <= range.hue_high) return within(range.hue_low, range.hue_high, mask);
  cv::Mat above;
  within(range.hue_low, 179, above);
  within(0, range.hue_high, mask);
  cv::bitwise_or(above, mask, mask);
}

void darkenBackground(cv::Mat& scaled, const cv::Mat& background, int threshold) {
  cv::Mat difference, largest, still;
  cv::absdiff(scaled, background, difference);
  std::vector<cv::Mat> channels;
  cv::split(difference, channels);
  largest = cv::max(cv::max(channels[0], channels[1]), channels[2]);
  still = largest <= threshold;
  scaled.convertTo(difference, -1, 0.22);
  difference += cv::Scalar(34, 20, 8);  // a blue night
  difference.copyTo(scaled, still);
}

void tint(cv::Mat& scaled, const cv::Mat& mask) {
  cv::Mat tinted;
  cv::addWeighted(scaled, 0.25, cv::Mat(scaled.size(), CV_8UC3, cv::Scalar(255, 60, 255)), 0.75, 0.0, tinted);
  tinted.copyTo(scaled, mask);
}

int percentile(std::vector<int>& values, double fraction) {
  const auto at =
      values.begin() + static_cast<std::ptrdiff_t>(fraction * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

/// Pixels in HSV that are connected to `seed` and much like their neighbours.
std::vector<cv::Vec3b> regionAround(const cv::Mat& bgr, cv::Point seed) {
  const cv::Rect window = cv::Rect(seed.x - kReach, seed.y - kReach, 2 * kReach + 1, 2 * kReach + 1) &
                          cv::Rect(0, 0, bgr.cols, bgr.rows);
  cv::Mat part = bgr(window).clone(), hsv;
  cv::Mat mask = cv::Mat::zeros(part.rows + 2, part.cols + 2, CV_8U);
  cv::cvtColor(part, hsv, cv::COLOR_BGR2HSV);
  const cv::Scalar likeness = cv::Scalar::all(kLikeness);
  cv::floodFill(part, mask, seed - window.tl(), cv::Scalar(), nullptr, likeness, likeness,
                4 | cv::FLOODFILL_MASK_ONLY | (255 << 8));
  std::vector<cv::Vec3b> pixels;
  for (int y = 0; y < hsv.rows; ++y)
    for (int x = 0; x < hsv.cols; ++x)
      if (mask.at<std::uint8_t>(y + 1, x + 1) != 0) pixels.push_back(hsv.at<cv::Vec3b>(y, x));
  return pixels;
}

}  // namespace

void scalePicture(const CameraPicture& picture, const PictureViewport& viewport, const PictureMasks& masks,
                  double device_pixel_ratio, QImage& image) {
  const QSize size = (QSizeF(viewport.area().size()) * device_pixel_ratio).toSize().expandedTo(QSize(1, 1));
  if (image.size() != size) image = QImage(size, QImage::Format_RGB32);
  image.setDevicePixelRatio(device_pixel_ratio);
  cv::Mat target(size.height(), size.width(), CV_8UC4, image.bits(),
                 static_cast<std::size_t>(image.bytesPerLine()));
  cv::Mat scaled;
  resizeVisible(matOf(picture.bgr, picture.width, picture.height), viewport, target.size(), scaled);
  // Before the colours of anything are changed.
  const cv::Mat original = masks.colour && masks.background ? scaled.clone() : scaled;
  if (masks.background && picture.background && picture.background->size() == picture.bgr.size()) {
    cv::Mat background;
    resizeVisible(matOf(*picture.background, picture.width, picture.height), viewport, target.size(),
                  background);
    darkenBackground(scaled, background, masks.background_threshold);
  }
  if (masks.colour) {
    cv::Mat mask;
    colourMask(original, masks.range, mask);
    tint(scaled, mask);
  }
  cv::cvtColor(scaled, target, cv::COLOR_BGR2BGRA);
}

bool colourOfBall(const CameraPicture& picture, const Eigen::Vector2d& pixel, ColourRange& range) {
  const cv::Point seed(static_cast<int>(std::lround(pixel.x())), static_cast<int>(std::lround(pixel.y())));
  if (picture.bgr.empty() || seed.x < 0 || seed.y < 0 || seed.x >= picture.width || seed.y >= picture.height)
    return false;
  const auto pixels = regionAround(matOf(picture.bgr, picture.width, picture.height), seed);
  if (static_cast<int>(pixels.size()) < kFewestPixels) return false;
  // Hues are on a circle of 180: about their mean direction they are on a line.
  double along = 0.0, across = 0.0;
  for (const auto& hsv : pixels) {
    along += hsv[1] * std::cos(hsv[0] * CV_PI / 90.0);
    across += hsv[1] * std::sin(hsv[0] * CV_PI / 90.0);
  }
  const int mean = static_cast<int>(std::lround(std::atan2(across, along) * 90.0 / CV_PI));
  std::vector<int> hues, saturations, values;
  for (const auto& hsv : pixels) {
    if (hsv[1] >= kGreySaturation) hues.push_back((hsv[0] - mean + 90 + 360) % 180 - 90);
    saturations.push_back(hsv[1]);
    values.push_back(hsv[2]);
  }
  if (static_cast<int>(hues.size()) < kFewestPixels) return false;
  const auto wrapped = [](int hue) { return (hue + 360) % 180; };
  range.hue_low = wrapped(mean + percentile(hues, 0.05) - kHueMargin);
  range.hue_high = wrapped(mean + percentile(hues, 0.95) + kHueMargin);
  range.saturation_low = std::max(kGreySaturation, percentile(saturations, 0.05) - kSaturationMargin);
  range.saturation_high = 255;
  range.value_low = std::max(25, percentile(values, 0.05) - kValueMargin);
  range.value_high = 255;
  return true;
}

}  // namespace helical
