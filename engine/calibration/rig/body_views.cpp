#include "engine/calibration/rig/body_views.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <opencv2/calib3d.hpp>
#include <opencv2/core/eigen.hpp>

#include "engine/geometry/camera_resection.h"

namespace helical {
namespace {

constexpr double kFlat = 1e-3;  // thickness over length
constexpr double kThin = 0.02;  // width over length: such points leave a rotation open
constexpr double kFewestInlierShare = 0.5;

/// How far the points reach along their three main directions, largest first.
Eigen::Vector3d spread(std::span<const WorldPoint> points) {
  Eigen::Matrix3Xd centred(3, static_cast<Eigen::Index>(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i)
    centred.col(static_cast<Eigen::Index>(i)) = points[i].in_world;
  centred.colwise() -= centred.rowwise().mean().eval();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(centred * centred.transpose(),
                                                             Eigen::EigenvaluesOnly);
  return eigen.eigenvalues().reverse().cwiseMax(0.0).cwiseSqrt();
}

class View {
 public:
  View(const CameraModel& camera, std::span<const Sighting> sightings, double tolerance_px)
      : camera_(camera), tolerance_px_(tolerance_px) {
    for (const Sighting& s : sightings) {
      points_.push_back({s.in_body, s.pixel});
      object_.emplace_back(s.in_body.x(), s.in_body.y(), s.in_body.z());
      image_.emplace_back(s.bearing.x(), s.bearing.y());
    }
  }

  std::vector<RigidTransform> poses() {
    if (points_.size() < 4) return {};
    const Eigen::Vector3d size = spread(points_);
    if (size[1] < kThin * size[0]) return {};
    const bool flat = size[2] < kFlat * size[0];
    if (!flat && points_.size() < 6) return byRandomSamples();
    std::vector<RigidTransform> found = refined(direct(flat));
    if (found.empty() && points_.size() >= 6) found = byRandomSamples();
    return found;
  }

 private:
  std::vector<RigidTransform> direct(bool flat) const {
    std::vector<cv::Mat> rotations, translations;
    try {
      cv::solvePnPGeneric(object_, image_, cv::Mat::eye(3, 3, CV_64F), cv::noArray(), rotations, translations,
                          false, flat ? cv::SOLVEPNP_IPPE : cv::SOLVEPNP_SQPNP);
    } catch (const cv::Exception&) {  // degenerate points
      return {};
    }
    std::vector<RigidTransform> out;
    for (std::size_t i = 0; i < rotations.size(); ++i) out.push_back(fromCv(rotations[i], translations[i]));
    return out;
  }

  std::vector<RigidTransform> byRandomSamples() const {
    cv::Mat rotation, translation;
    std::vector<int> inliers;
    if (!cv::solvePnPRansac(object_, image_, cv::Mat::eye(3, 3, CV_64F), cv::noArray(), rotation, translation,
                            false, 300, static_cast<float>(tolerance_px_ / camera_.fx()), 0.999, inliers,
                            cv::SOLVEPNP_AP3P))
      return {};
    return refined({fromCv(rotation, translation)});
  }

  std::vector<RigidTransform> refined(const std::vector<RigidTransform>& starts) const {
    std::vector<RigidTransform> out;
    ResectionOptions options;
    options.robust_scale_px = tolerance_px_;
    for (const RigidTransform& start : starts) {
      const Resection r = resectCamera(camera_, points_, start, options);
      const bool solved =
          r.status == ResectionStatus::kConverged || r.status == ResectionStatus::kIterationLimit;
      if (solved && r.inliers >= 4 && r.inliers >= kFewestInlierShare * static_cast<double>(points_.size()))
        out.push_back(r.camera_from_world);
    }
    return out;
  }

  static RigidTransform fromCv(const cv::Mat& rotation_vector, const cv::Mat& translation) {
    cv::Mat rotation;
    cv::Rodrigues(rotation_vector, rotation);
    Eigen::Matrix3d r;
    Eigen::Vector3d t;
    cv::cv2eigen(rotation, r);
    cv::cv2eigen(translation, t);
    return {Eigen::Quaterniond(r).normalized(), t};
  }

  const CameraModel& camera_;
  double tolerance_px_;
  std::vector<WorldPoint> points_;
  std::vector<cv::Point3d> object_;
  std::vector<cv::Point2d> image_;
};

}  // namespace

std::vector<BodyView> poseBodyViews(std::span<const RigCamera> cameras, const SightingTable& table,
                                    double tolerance_px) {
  std::vector<BodyView> views;
  const std::span<const Sighting> all = table.sightings;
  for (std::size_t i = 0; i < all.size();) {
    std::size_t j = i;
    while (j < all.size() && all[j].item == all[i].item && all[j].camera == all[i].camera) ++j;
    View view(cameras[static_cast<std::size_t>(all[i].camera)].model, all.subspan(i, j - i), tolerance_px);
    auto poses = view.poses();
    if (!poses.empty()) views.push_back({all[i].item, all[i].camera, std::move(poses)});
    i = j;
  }
  return views;
}

}  // namespace helical
