#include "engine/calibration/rig/pair_geometry.h"

#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/core/eigen.hpp>
#include <vector>

#include "engine/calibration/rig/quantile.h"
#include "engine/geometry/rotation.h"

namespace helical {
namespace {

constexpr int kFewestPoints = 12;
constexpr int kRandomSamples = 5000;
constexpr double kConfidence = 0.9999;
constexpr double kFarAway = 1e4;  // baselines

std::vector<cv::Point2d> toCv(std::span<const Eigen::Vector2d> bearings) {
  std::vector<cv::Point2d> out;
  out.reserve(bearings.size());
  for (const auto& b : bearings) out.emplace_back(b.x(), b.y());
  return out;
}

RigidTransform fromCv(const cv::Mat& rotation, const cv::Mat& translation) {
  Eigen::Matrix3d r;
  Eigen::Vector3d t;
  cv::cv2eigen(rotation, r);
  cv::cv2eigen(translation, t);
  return {Eigen::Quaterniond(r).normalized(), t};
}

double medianParallaxDeg(std::span<const Eigen::Vector2d> a, std::span<const Eigen::Vector2d> b,
                         const cv::Mat& mask, const RigidTransform& b_from_a) {
  std::vector<double> angles;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (mask.at<unsigned char>(static_cast<int>(i)) == 0) continue;
    const Eigen::Vector3d ray = (b_from_a.rotation * a[i].homogeneous()).normalized();
    angles.push_back(std::acos(std::clamp(ray.dot(b[i].homogeneous().normalized()), -1.0, 1.0)));
  }
  return toDegrees(quantileOf(angles, 0.5));
}

}  // namespace

std::optional<PairGeometry> relatePair(std::span<const Eigen::Vector2d> bearings_a,
                                       std::span<const Eigen::Vector2d> bearings_b, double tolerance,
                                       int samples) {
  if (bearings_a.size() < kFewestPoints) return std::nullopt;
  const auto a = toCv(bearings_a), b = toCv(bearings_b);
  const cv::Mat identity = cv::Mat::eye(3, 3, CV_64F);
  cv::Mat mask;
  const cv::Mat essential =
      cv::findEssentialMat(a, b, identity, cv::RANSAC, kConfidence, tolerance, samples, mask);
  if (essential.rows != 3 || essential.cols != 3) return std::nullopt;
  cv::Mat rotation, translation;
  PairGeometry pair;
  pair.inliers = cv::recoverPose(essential, a, b, identity, rotation, translation, kFarAway, mask);
  if (pair.inliers < kFewestPoints) return std::nullopt;
  pair.b_from_a = fromCv(rotation, translation);
  pair.parallax_deg = medianParallaxDeg(bearings_a, bearings_b, mask, pair.b_from_a);
  return pair;
}

std::optional<PointResection> resectByPoints(std::span<const Eigen::Vector3d> in_world,
                                             std::span<const Eigen::Vector2d> bearings, double tolerance) {
  if (in_world.size() < 6) return std::nullopt;
  std::vector<cv::Point3d> points;
  points.reserve(in_world.size());
  for (const auto& p : in_world) points.emplace_back(p.x(), p.y(), p.z());
  const cv::Mat identity = cv::Mat::eye(3, 3, CV_64F);
  cv::Mat rotation_vector, translation, rotation;
  std::vector<int> inliers;
  const bool found =
      cv::solvePnPRansac(points, toCv(bearings), identity, cv::noArray(), rotation_vector, translation, false,
                         kRandomSamples, static_cast<float>(tolerance), 0.999, inliers, cv::SOLVEPNP_AP3P);
  if (!found || inliers.size() < 6) return std::nullopt;
  cv::Rodrigues(rotation_vector, rotation);
  return PointResection{fromCv(rotation, translation), static_cast<int>(inliers.size())};
}

}  // namespace helical
