#include "ui/picture_scaler.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <vector>

namespace helical {
namespace {

constexpr int kReach = 40;      // px about the click that may belong to the ball
constexpr int kMiss = 3;        // px that a click may be beside a coloured pixel
constexpr int kHueReach = 12;   // of 180, within which it is the same ball
constexpr int kDarkValue = 25;  // below, a hue means nothing, either
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

bool isColoured(const cv::Vec3b& hsv) {
  return hsv[1] >= kGreySaturation && hsv[2] >= kDarkValue;
}

/// The coloured pixel nearest to a click that may have hit a highlight or missed by a little.
std::optional<cv::Point> nearestColoured(const cv::Mat& hsv, cv::Point click) {
  std::optional<cv::Point> nearest;
  int best = kMiss * kMiss + 1;
  for (int dy = -kMiss; dy <= kMiss; ++dy)
    for (int dx = -kMiss; dx <= kMiss; ++dx) {
      const cv::Point at(click.x + dx, click.y + dy);
      if (at.x < 0 || at.y < 0 || at.x >= hsv.cols || at.y >= hsv.rows) continue;
      const int distance = dx * dx + dy * dy;
      if (distance >= best || !isColoured(hsv.at<cv::Vec3b>(at))) continue;
      best = distance;
      nearest = at;
    }
  return nearest;
}

/// Pixels in HSV that are connected to the click and of its hue: shading changes a small ball's brightness
/// from one pixel to the next by more than its rim does.
std::vector<cv::Vec3b> regionAround(const cv::Mat& bgr, cv::Point click) {
  const cv::Rect window = cv::Rect(click.x - kReach, click.y - kReach, 2 * kReach + 1, 2 * kReach + 1) &
                          cv::Rect(0, 0, bgr.cols, bgr.rows);
  cv::Mat hsv;
  cv::cvtColor(bgr(window), hsv, cv::COLOR_BGR2HSV);
  const std::optional<cv::Point> seed = nearestColoured(hsv, click - window.tl());
  if (!seed) return {};
  const int hue = hsv.at<cv::Vec3b>(*seed)[0];
  cv::Mat alike = cv::Mat::zeros(hsv.size(), CV_8U);
  for (int y = 0; y < hsv.rows; ++y)
    for (int x = 0; x < hsv.cols; ++x) {
      const auto& pixel = hsv.at<cv::Vec3b>(y, x);
      const int away = std::abs(pixel[0] - hue);
      if (isColoured(pixel) && std::min(away, 180 - away) <= kHueReach) alike.at<std::uint8_t>(y, x) = 1;
    }
  cv::floodFill(alike, *seed, cv::Scalar(2));
  std::vector<cv::Vec3b> pixels;
  for (int y = 0; y < hsv.rows; ++y)
    for (int x = 0; x < hsv.cols; ++x)
      if (alike.at<std::uint8_t>(y, x) == 2) pixels.push_back(hsv.at<cv::Vec3b>(y, x));
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
