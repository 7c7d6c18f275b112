#include "tests/calibration/training_flight.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>

#include "engine/base/random.h"
#include "engine/calibration/camera_perturbation.h"
#include "engine/calibration/cramer_rao.h"
#include "engine/geometry/camera_perturbation.h"
#include "engine/geometry/rotation.h"

namespace helical::test {
namespace {

constexpr double kRateHz = 60.0;

Eigen::Vector3d normalVector(Random& random) {
  return {random.normal(), random.normal(), random.normal()};
}

/// Twice low-pass filtered noise.
class Wander {
 public:
  Wander(double size, double time_constant_s) : size_(size), time_constant_s_(time_constant_s) {}
  double next(Random& random) {
    const double keep = std::exp(-1.0 / kRateHz / time_constant_s_);
    fast_ = keep * fast_ + std::sqrt(1.0 - keep * keep) * random.normal();
    slow_ += (fast_ - slow_) * (1.0 - std::exp(-1.0 / kRateHz / (0.6 * time_constant_s_)));
    return 1.26 * size_ * slow_;
  }

 private:
  double size_, time_constant_s_, fast_ = 0.0, slow_ = 0.0;
};

double smoothStep(double u) {
  u = std::clamp(u, 0.0, 1.0);
  return u * u * (3.0 - 2.0 * u);
}

RigidTransform lookingAt(const Eigen::Vector3d& centre, const Eigen::Vector3d& target, double roll) {
  const Eigen::Vector3d z = (target - centre).normalized();
  const Eigen::Vector3d x = z.cross(Eigen::Vector3d::UnitZ()).normalized();
  Eigen::Matrix3d rows;
  rows << x.transpose(), z.cross(x).transpose(), z.transpose();
  RigidTransform pose;
  pose.rotation = (expSO3(Eigen::Vector3d(0, 0, roll)) * Eigen::Quaterniond(rows)).normalized();
  pose.translation = -(pose.rotation * centre);
  return pose;
}

RigidTransform placeCamera(double azimuth, Random& random) {
  azimuth += toRadians(random.uniform(-15.0, 15.0));
  const double elevation = toRadians(random.uniform(30.0, 50.0));
  const Eigen::Vector3d away(std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
                             std::sin(elevation));
  const Eigen::Vector3d centre = Eigen::Vector3d(0, 0, 0.3) + random.uniform(2.3, 3.2) * away;
  const Eigen::Vector3d target(0.1 * random.normal(), 0.1 * random.normal(), 0.3);
  return lookingAt(centre, target, toRadians(3.0) * random.normal());
}

std::vector<RigidTransform> hover(double duration_s, Random& random) {
  std::array<Wander, 6> wander{Wander(0.04, 1.0),           Wander(0.04, 1.0),
                               Wander(0.015, 1.0),          Wander(toRadians(2.5), 0.4),
                               Wander(toRadians(2.5), 0.4), Wander(toRadians(6.0), 2.0)};
  const double start_yaw = random.uniform(-0.2, 0.2);
  std::vector<RigidTransform> poses;
  for (int k = -300; k < static_cast<int>(duration_s * kRateHz); ++k) {
    std::array<double, 6> w;
    for (std::size_t i = 0; i < 6; ++i) w[i] = wander[i].next(random);
    if (k < 0) continue;
    const double height = 0.6 * smoothStep((k / kRateHz - 1.0) / 3.0);
    const double free = std::min(1.0, height / 0.1);
    RigidTransform pose;
    pose.translation = Eigen::Vector3d(w[0] * free, w[1] * free, height + 0.06 + w[2] * free);
    pose.rotation = expSO3(Eigen::Vector3d(0, 0, start_yaw + w[5] * free)) *
                    expSO3(Eigen::Vector3d(w[3] * free, w[4] * free, 0));
    poses.push_back(pose);
  }
  return poses;
}

std::vector<LabelledPixel> look(const TrainingFlight& flight, const RigidTransform& world_from_body,
                                const TrainingFlightOptions& options, Random& random) {
  std::vector<LabelledPixel> pixels;
  for (int m = 0; m < flight.markers.count(); ++m) {
    const auto pixel = flight.camera.project(flight.camera_from_world *
                                             (world_from_body * flight.markers.inBody(markerId(m))));
    const Eigen::Vector2d noise(random.normal(), random.normal());
    const bool dropped = random.uniform() < options.drop_outs;
    const bool outlier = random.uniform() < options.outliers;
    const Eigen::Vector2d jump(random.uniform(-80.0, 80.0), random.uniform(-80.0, 80.0));
    if (!pixel || !flight.camera.contains(*pixel) || dropped) continue;
    pixels.push_back({markerId(m), *pixel + (outlier ? jump : Eigen::Vector2d(options.sigma_px * noise)),
                      options.sigma_px * options.sigma_px * Eigen::Matrix2d::Identity()});
  }
  return pixels;
}

/// Unnamed: begins with another ball in each frame.
Observation withoutNames(const TrainingFlight::Frame& frame, std::size_t first) {
  Observation observation;
  observation.exposure = frame.exposure;
  for (std::size_t i = 0; i < frame.pixels.size(); ++i) {
    const LabelledPixel& seen = frame.pixels[(first + i) % frame.pixels.size()];
    Centroid& centroid = observation.centroids[static_cast<std::size_t>(observation.count++)];
    centroid.pixel = seen.pixel;
    centroid.covariance = seen.covariance;
  }
  return observation;
}

}  // namespace

TrainingFlight flyForTraining(std::uint64_t seed, const TrainingFlightOptions& options) {
  Random random(seed);
  TrainingFlight flight;
  flight.markers = options.markers;
  flight.camera = CameraModel(640, 480, 567.6, 567.6, 319.5, 239.5);
  const std::array<RigidTransform, 2> calibrated{placeCamera(-kPi / 4, random), placeCamera(kPi / 4, random)};
  flight.camera_from_world = placeCamera(kPi, random);
  Vector6d off;
  off.head<3>() = options.guess_rotation_rad * normalVector(random).normalized();
  off.tail<3>() = options.guess_position_m * normalVector(random).normalized();
  flight.guess = perturbCamera(flight.camera_from_world, off);

  const std::array<MarkerId, 4> all{markerId(0), markerId(1), markerId(2), markerId(3)};
  const auto poses = hover(options.duration_s, random);
  for (std::size_t k = 0; k < poses.size(); ++k) {
    TrainingFlight::Frame frame;
    frame.exposure = fromSeconds(static_cast<double>(k) / kRateHz);
    frame.true_world_from_body = poses[k];
    const Eigen::Vector3d shift = options.pose_position_sigma_m * normalVector(random);
    const Eigen::Vector3d turn = options.pose_rotation_sigma_rad * normalVector(random);
    frame.world_from_body = {poses[k].rotation * expSO3(turn), poses[k].translation + shift};
    frame.pose_covariance = Matrix6d::Zero();
    frame.pose_covariance.diagonal().head<3>().setConstant(std::pow(options.pose_position_sigma_m, 2));
    frame.pose_covariance.diagonal().tail<3>().setConstant(std::pow(options.pose_rotation_sigma_rad, 2));
    frame.pose_information = Matrix6d::Zero();
    for (const auto& pose : calibrated)
      frame.pose_information +=
          poseInformation(flight.camera, pose, flight.markers, all, poses[k], options.sigma_px);
    frame.pixels = look(flight, poses[k], options, random);
    frame.observation = withoutNames(frame, k);
    flight.frames.push_back(std::move(frame));
  }
  return flight;
}

double positionError(const RigidTransform& a, const RigidTransform& b) {
  return (a.inverseTranslation() - b.inverseTranslation()).norm();
}

double orientationError(const RigidTransform& a, const RigidTransform& b) {
  return a.rotation.angularDistance(b.rotation);
}

}  // namespace helical::test
