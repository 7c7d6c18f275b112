#include "engine/calibration/joint_frame.h"

#include <algorithm>
#include <array>

#include "engine/calibration/camera_perturbation.h"
#include "engine/correspondence/prediction_naming.h"

namespace helical {
namespace {

constexpr double kGateChi2 = 30.0;
constexpr double kSlackPx = 1.5;  // for offsets that no covariance tells of: a ball this near is the ball

double largestVariance(const Observation& observation) {
  double largest = 0.0;
  for (int c = 0; c < observation.count; ++c)
    largest = std::max(largest,
                       observation.centroids[static_cast<std::size_t>(c)].covariance.diagonal().maxCoeff());
  return largest;
}

}  // namespace

void nameCentroids(const CameraModel& camera, const MarkerLayout& markers,
                   const RigidTransform& camera_from_world, const Matrix6d& camera_covariance,
                   const UnnamedFrame& frame, StoredFrame& named) {
  named.world_from_body = frame.world_from_body;
  named.pose_covariance = frame.pose_covariance;
  named.count = 0;
  const double own = largestVariance(frame.observation) + kSlackPx * kSlackPx;
  const RigidTransform camera_from_body = camera_from_world * frame.world_from_body;
  std::array<MarkerPrediction, kMaxMarkers> predictions;
  for (int m = 0; m < markers.count(); ++m) {
    const MarkerId marker = markerId(m);
    const auto ball = projectMarker(camera, camera_from_world, frame.world_from_body, markers.inBody(marker));
    if (!ball) continue;
    MarkerPrediction& prediction = predictions[static_cast<std::size_t>(m)];
    prediction.visible = true;
    prediction.pixel = ball->pixel;
    prediction.covariance = own * Eigen::Matrix2d::Identity();
    prediction.covariance.noalias() += ball->d_pose * frame.pose_covariance * ball->d_pose.transpose();
    prediction.covariance.noalias() += ball->d_camera * camera_covariance * ball->d_camera.transpose();
    prediction.radius_px = camera.fx() * markers.radius() / (camera_from_body * markers.inBody(marker)).z();
  }
  const Names names = nameByPrediction({predictions.data(), static_cast<std::size_t>(markers.count())},
                                       frame.observation, kGateChi2);
  for (int m = 0; m < markers.count(); ++m) {
    const int name = names[static_cast<std::size_t>(m)];
    if (name < 0) continue;
    const Centroid& centroid = frame.observation.centroids[static_cast<std::size_t>(name)];
    named.pixels[static_cast<std::size_t>(named.count++)] = {markerId(m), centroid.pixel,
                                                             centroid.covariance};
  }
}

}  // namespace helical
