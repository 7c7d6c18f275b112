#include "engine/calibration/intrinsics/intrinsics_calibration.h"

#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/core/eigen.hpp>

#include "engine/base/error.h"
#include "engine/calibration/intrinsics/intrinsics_verdict.h"
#include "engine/geometry/rotation.h"

namespace helical {
namespace {

constexpr std::size_t kFewestViews = 3;
constexpr double kOutlierFactor = 3.0;   // times the median view's residual
constexpr double kOutlierFloorPx = 0.3;  // below it no view is an outlier
constexpr double kMostOutliers = 0.25;   // of the views

constexpr std::array<const char*, 9> kParts = {"top left",    "top middle",    "top right",
                                               "middle left", "middle",        "middle right",
                                               "bottom left", "bottom middle", "bottom right"};

struct Solution {
  cv::Mat camera, distortion, sigma;
  std::vector<cv::Mat> rotations;
  std::vector<double> view_rms;
  double rms = 0.0;
};

Solution solve(const std::vector<const BoardView*>& views, cv::Size size, bool rational) {
  std::vector<std::vector<cv::Point3f>> points;
  std::vector<std::vector<cv::Point2f>> pixels;
  for (const BoardView* view : views) {
    points.emplace_back();
    pixels.emplace_back();
    for (std::size_t i = 0; i < view->pixels.size(); ++i) {
      points.back().emplace_back(static_cast<float>(view->on_board[i].x()),
                                 static_cast<float>(view->on_board[i].y()), 0.0F);
      pixels.back().emplace_back(static_cast<float>(view->pixels[i].x()),
                                 static_cast<float>(view->pixels[i].y()));
    }
  }
  Solution s;
  std::vector<cv::Mat> translations;
  cv::Mat extrinsic_sigma, view_errors;
  try {
    s.rms =
        cv::calibrateCamera(points, pixels, size, s.camera, s.distortion, s.rotations, translations, s.sigma,
                            extrinsic_sigma, view_errors, rational ? cv::CALIB_RATIONAL_MODEL : 0,
                            cv::TermCriteria(cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 100, 1e-9));
  } catch (const cv::Exception&) {  // views that determine nothing
    throw Error(ErrorKind::kInput, "no camera explains these views", {},
                "take sharp views of a flat board from all sides, and check --board");
  }
  for (int i = 0; i < view_errors.rows; ++i) s.view_rms.push_back(view_errors.at<double>(i));
  return s;
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Largest angle between the board's normals in any two views.
double tiltDeg(const std::vector<cv::Mat>& rotations) {
  std::vector<Eigen::Vector3d> normals;
  for (const cv::Mat& vector : rotations) {
    cv::Mat rotation;
    cv::Rodrigues(vector, rotation);
    normals.emplace_back(rotation.at<double>(0, 2), rotation.at<double>(1, 2), rotation.at<double>(2, 2));
  }
  double least = 1.0;
  for (const auto& a : normals)
    for (const auto& b : normals) least = std::min(least, a.dot(b));
  return toDegrees(std::acos(std::clamp(least, -1.0, 1.0)));
}

CameraModel modelOf(const Solution& s, int width, int height) {
  std::array<double, 8> distortion{};
  const int count = std::min(8, static_cast<int>(s.distortion.total()));
  for (int i = 0; i < count; ++i) distortion[static_cast<std::size_t>(i)] = s.distortion.at<double>(i);
  return CameraModel(width, height, s.camera.at<double>(0, 0), s.camera.at<double>(1, 1),
                     s.camera.at<double>(0, 2), s.camera.at<double>(1, 2), distortion);
}

void countCoverage(IntrinsicsCalibration& c, std::span<const BoardView> views, int width, int height) {
  for (std::size_t i = 0; i < views.size(); ++i) {
    if (!c.views[i].used) continue;
    for (const Eigen::Vector2d& p : views[i].pixels) {
      const int column = std::clamp(static_cast<int>(3.0 * p.x() / width), 0, 2);
      const int row = std::clamp(static_cast<int>(3.0 * p.y() / height), 0, 2);
      ++c.coverage[static_cast<std::size_t>(3 * row + column)];
    }
  }
  for (std::size_t i = 0; i < kParts.size(); ++i)
    if (c.coverage[i] == 0) c.uncovered.emplace_back(kParts[i]);
}

}  // namespace

IntrinsicsCalibration calibrateIntrinsics(std::span<const BoardView> views, int width, int height,
                                          bool rational) {
  if (views.size() < kFewestViews)
    throw Error(
        ErrorKind::kInput, "the board was found in " + std::to_string(views.size()) + " images", {},
        "give 3 images at least, better 15 to 30, with the whole board, sharp; check --board and --charuco");
  IntrinsicsCalibration c;
  std::vector<const BoardView*> used;
  for (const BoardView& view : views) {
    c.views.push_back({view.name, static_cast<int>(view.pixels.size()), 0.0, true});
    used.push_back(&view);
  }
  Solution s = solve(used, cv::Size(width, height), rational);
  // One at a time, the worst first: an outlier spoils the residuals of all others.
  for (auto left_out = std::size_t{0};; ++left_out) {
    const auto worst = std::max_element(s.view_rms.begin(), s.view_rms.end());
    const auto index = static_cast<std::size_t>(worst - s.view_rms.begin());
    const bool outlier = *worst > std::max(kOutlierFloorPx, kOutlierFactor * median(s.view_rms));
    const bool may = used.size() > kFewestViews + 1 &&
                     static_cast<double>(left_out + 1) <= kMostOutliers * static_cast<double>(views.size());
    if (!outlier || !may) break;
    IntrinsicsView& view = c.views[static_cast<std::size_t>(used[index] - views.data())];
    view.used = false;
    view.rms_px = *worst;
    used.erase(used.begin() + static_cast<std::ptrdiff_t>(index));
    s = solve(used, cv::Size(width, height), rational);
  }
  for (std::size_t i = 0; i < used.size(); ++i)
    c.views[static_cast<std::size_t>(used[i] - views.data())].rms_px = s.view_rms[i];
  c.model = modelOf(s, width, height);
  for (int i = 0; i < std::min(rational ? 12 : 9, static_cast<int>(s.sigma.total())); ++i)
    c.sigma[static_cast<std::size_t>(i)] = s.sigma.at<double>(i);
  c.rms_px = s.rms;
  c.tilt_deg = tiltDeg(s.rotations);
  countCoverage(c, views, width, height);
  judge(c);
  return c;
}

}  // namespace helical
