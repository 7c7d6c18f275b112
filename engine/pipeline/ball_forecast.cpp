#include "engine/pipeline/ball_forecast.h"

#include <Eigen/Geometry>
#include <cmath>

#include "engine/geometry/rotation.h"

namespace helical {
namespace {

constexpr double kSigmas = 4.0;
constexpr double kSlack = 3.0;        // px, for what the covariances do not know: a partly hidden ball
constexpr double kSpeedError = 0.6;   // m/s, of a ball: its known speed may be off and changes
constexpr double kLargestReach = 60;  // px: a pose that says so little is none

}  // namespace

BallPredictions forecastBalls(const TrackedState& tracked, const CameraEstimate& estimate,
                              const CameraModel& camera, const MarkerLayout& markers) {
  BallPredictions predictions;
  predictions.time = tracked.time;
  const RigidTransform& world_from_body = tracked.state.world_from_body;
  const Eigen::Matrix3d camera_from_world = estimate.camera_from_world.rotation.toRotationMatrix();
  const Eigen::Matrix3d body_in_world = world_from_body.rotation.toRotationMatrix();
  for (const Eigen::Vector3d& marker : markers.all()) {
    const Eigen::Vector3d in_camera = estimate.camera_from_world * (world_from_body * marker);
    Eigen::Matrix<double, 2, 3> d_point;
    const auto pixel = camera.project(in_camera, &d_point);
    if (!pixel) continue;
    PredictedBall ball;
    ball.pixel = *pixel;
    ball.radius_px = camera.fx() * markers.radius() / in_camera.z();
    if (!camera.contains(*pixel, -ball.radius_px - kLargestReach)) continue;
    const Eigen::Matrix<double, 2, 3> d_world = d_point * camera_from_world;
    Eigen::Matrix<double, 2, 6> d_pose, d_camera;
    d_pose << d_world, -d_world * body_in_world * hat(marker);
    d_camera << -d_point * hat(in_camera), -d_world;
    ball.velocity = d_pose.leftCols<3>() * tracked.state.velocity_in_world +
                    d_pose.rightCols<3>() * tracked.state.angular_velocity_in_body;
    const Eigen::Matrix2d covariance = d_pose * tracked.pose_covariance * d_pose.transpose() +
                                       d_camera * estimate.covariance * d_camera.transpose();
    ball.reach_px = kSlack + kSigmas * std::sqrt(covariance.trace());
    ball.reach_rate_px_s = kSpeedError * camera.fx() / in_camera.z();
    ball.whole = camera.contains(*pixel, ball.radius_px + ball.reach_px);
    if (!(ball.reach_px < kLargestReach)) return {};
    predictions.balls[static_cast<std::size_t>(predictions.count++)] = ball;
  }
  return predictions;
}

}  // namespace helical
