#include "tests/tracking/field.h"

#include <cmath>

#include "engine/geometry/rotation.h"

namespace helical {
namespace {

RigidTransform cameraAt(double azimuth, double elevation) {
  const Eigen::Vector3d target(0, 0, 0.3);
  const Eigen::Vector3d back(std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
                             std::sin(elevation));
  const Eigen::Vector3d z = -back, x = z.cross(Eigen::Vector3d::UnitZ()).normalized(), y = z.cross(x);
  Eigen::Matrix3d rotation;
  rotation << x.transpose(), y.transpose(), z.transpose();
  const Eigen::Quaterniond q(rotation);
  return {q, -(q * (target + 2.7 * back))};
}

}  // namespace

Field::Field() {
  for (const double azimuth : {-65.0, 60.0, 180.0}) {
    usable[models.size()] = true;
    models.emplace_back(640, 480, 567.6, 567.6, 319.5, 239.5,
                        std::array<double, 8>{-0.05, 0.01, 0.0004, -0.0003, 0.0});
    CameraEstimate estimate;
    estimate.camera_from_world = cameraAt(toRadians(azimuth), toRadians(40.0));
    estimate.status = CameraStatus::kCalibrated;
    estimates.push_back(estimate);
  }
}

Observation Field::observe(int camera, TimeNs exposure, const RigidTransform& world_from_body, double sigma,
                           Random& random) const {
  const auto index = static_cast<std::size_t>(camera);
  Observation observation;
  observation.camera = cameraId(camera);
  observation.exposure = observation.arrival = exposure;
  for (const Eigen::Vector3d& marker : markers.all()) {
    const Eigen::Vector3d in_camera = estimates[index].camera_from_world * (world_from_body * marker);
    const auto pixel = models[index].project(in_camera);
    const Eigen::Vector2d noise(sigma * random.normal(), sigma * random.normal());
    if (!pixel || !models[index].contains(*pixel)) continue;
    const double radius = models[index].fx() * markers.radius() / in_camera.z();
    addCentroid(observation, *pixel + noise, kPi * radius * radius);
  }
  return observation;
}

void addCentroid(Observation& observation, const Eigen::Vector2d& pixel, double area_px) {
  Centroid& centroid = observation.centroids[static_cast<std::size_t>(observation.count++)];
  centroid.pixel = pixel;
  centroid.area_px = area_px;
  centroid.radius_px = std::sqrt(area_px / kPi);
  centroid.covariance = kCentroidSigma * kCentroidSigma * Eigen::Matrix2d::Identity();
}

RigidTransform onPad(Random& random, double yaw_range) {
  RigidTransform pose;
  pose.translation = {random.uniform(-0.05, 0.05), random.uniform(-0.05, 0.05), kStandingHeight};
  pose.rotation = expSO3({0, 0, random.uniform(-yaw_range, yaw_range)});
  return pose;
}

double distanceBetween(const RigidTransform& a, const RigidTransform& b) {
  return (a.translation - b.translation).norm();
}

double angleBetween(const RigidTransform& a, const RigidTransform& b) {
  return a.rotation.angularDistance(b.rotation);
}

}  // namespace helical
