#include "engine/experiments/calibration_field.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "engine/base/random.h"
#include "engine/geometry/camera_perturbation.h"
#include "engine/geometry/rotation.h"
#include "engine/simulator/simulation_options.h"
#include "engine/tracking/pose_fit.h"

namespace helical {
namespace {

constexpr double kStandingHeight = 0.06;
constexpr double kNamingSigmaPx = 6.0;  // how far from its true place a ball may be sought
constexpr double kNamingGateChi2 = 14.0;
constexpr double kRobustSigmas = 4.0;
constexpr double kInlierSigmas = 5.0;
constexpr int kFewestInliers = 5;  // of fewer, one false ball bends the pose and fits

/// Twice low-pass filtered noise.
class Wander {
 public:
  Wander(double size, double time_constant_s, double rate_hz)
      : size_(size),
        keep_(std::exp(-1.0 / rate_hz / time_constant_s)),
        follow_(1.0 - std::exp(-1.0 / rate_hz / (0.6 * time_constant_s))) {}
  double next(Random& random) {
    fast_ = keep_ * fast_ + std::sqrt(1.0 - keep_ * keep_) * random.normal();
    slow_ += (fast_ - slow_) * follow_;
    return 1.26 * size_ * slow_;
  }

 private:
  double size_, keep_, follow_, fast_ = 0.0, slow_ = 0.0;
};

double smoothStep(double u) {
  u = std::clamp(u, 0.0, 1.0);
  return u * u * (3.0 - 2.0 * u);
}

Eigen::Vector3d randomDirection(Random& random) {
  return Eigen::Vector3d(random.normal(), random.normal(), random.normal()).normalized();
}

RigidTransform placeCamera(double azimuth, Random& random) {
  azimuth += toRadians(random.uniform(-15.0, 15.0));
  const double elevation = toRadians(random.uniform(30.0, 50.0));
  const Eigen::Vector3d away(std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
                             std::sin(elevation));
  const Eigen::Vector3d centre = Eigen::Vector3d(0, 0, 0.3) + random.uniform(2.3, 3.2) * away;
  const Eigen::Vector3d target(0.1 * random.normal(), 0.1 * random.normal(), 0.3);
  const Eigen::Vector3d z = (target - centre).normalized();
  const Eigen::Vector3d x = z.cross(Eigen::Vector3d::UnitZ()).normalized();
  Eigen::Matrix3d rows;
  rows << x.transpose(), z.cross(x).transpose(), z.transpose();
  RigidTransform pose;
  pose.rotation = (expSO3({0, 0, toRadians(3.0) * random.normal()}) * Eigen::Quaterniond(rows)).normalized();
  pose.translation = -(pose.rotation * centre);
  return pose;
}

std::vector<RigidTransform> fly(const CalibrationFieldOptions& options, Random random) {
  const double rate = options.rate_hz;
  std::array<Wander, 6> wander{Wander(0.04, 1.0, rate),           Wander(0.04, 1.0, rate),
                               Wander(0.015, 1.0, rate),          Wander(toRadians(2.5), 0.4, rate),
                               Wander(toRadians(2.5), 0.4, rate), Wander(toRadians(6.0), 2.0, rate)};
  const double start_yaw = random.uniform(-0.2, 0.2);
  std::vector<RigidTransform> poses;
  for (int k = static_cast<int>(-5.0 * rate); k < static_cast<int>(options.duration_s * rate); ++k) {
    std::array<double, 6> w;
    for (std::size_t i = 0; i < 6; ++i) w[i] = wander[i].next(random);
    if (k < 0) continue;
    const double height = 0.6 * smoothStep((k / rate - 1.0) / 3.0);
    const double free = std::min(1.0, height / 0.1);
    RigidTransform pose;
    pose.translation = {w[0] * free, w[1] * free, height + kStandingHeight + w[2] * free};
    pose.rotation = expSO3({0, 0, start_yaw + w[5] * free}) * expSO3({w[3] * free, w[4] * free, 0});
    poses.push_back(pose);
  }
  return poses;
}

/// What one camera finds of the balls, in an order of its own, and which they are.
struct Look {
  Observation observation;
  std::array<MarkerId, kMaxMarkers> truth;
  std::array<MarkerId, kMaxMarkers> not_thrown;  ///< those in their places
  std::size_t not_thrown_count = 0;
};

class Eye {
 public:
  Eye(const CameraModel& camera, const RigidTransform& camera_from_world, Random random)
      : camera_(camera), camera_from_world_(camera_from_world), random_(random) {}

  Look look(const RigidTransform& world_from_body, const CalibrationFieldOptions& options) {
    Look look;
    const int balls = options.markers.count();
    const auto first = static_cast<int>(random_.uniform() * balls);
    for (int i = 0; i < balls; ++i) add(markerId((first + i) % balls), world_from_body, options, look);
    return look;
  }
  const RigidTransform& pose() const { return camera_from_world_; }

 private:
  void add(MarkerId marker, const RigidTransform& world_from_body, const CalibrationFieldOptions& options,
           Look& look) {
    const Eigen::Vector3d in_body = options.true_markers.empty()
                                        ? options.markers.inBody(marker)
                                        : options.true_markers[static_cast<std::size_t>(marker.index())];
    const auto pixel = camera_.project(camera_from_world_ * (world_from_body * in_body));
    const Eigen::Vector2d noise(random_.normal(), random_.normal());
    const bool dropped = random_.uniform() < options.drop_outs;
    const bool thrown = random_.uniform() < options.outliers;
    const Eigen::Vector2d aside(random_.uniform(-kOutlierReachPx, kOutlierReachPx),
                                random_.uniform(-kOutlierReachPx, kOutlierReachPx));
    if (!pixel || !camera_.contains(*pixel) || dropped) return;
    const auto index = static_cast<std::size_t>(look.observation.count++);
    look.truth[index] = marker;
    if (!thrown) look.not_thrown[look.not_thrown_count++] = marker;
    Centroid& centroid = look.observation.centroids[index];
    centroid.pixel = *pixel + (thrown ? aside : Eigen::Vector2d(options.sigma_px * noise));
    centroid.covariance = options.sigma_px * options.sigma_px * Eigen::Matrix2d::Identity();
  }

  CameraModel camera_;
  RigidTransform camera_from_world_;
  Random random_;
};

Names namesNear(const CameraModel& camera, const MarkerLayout& markers,
                const RigidTransform& camera_from_world, const RigidTransform& world_from_body,
                const Observation& observation) {
  std::array<MarkerPrediction, kMaxMarkers> predictions;
  for (int m = 0; m < markers.count(); ++m)
    if (const auto pixel =
            camera.project(camera_from_world * (world_from_body * markers.inBody(markerId(m)))))
      predictions[static_cast<std::size_t>(m)] = {
          true, *pixel, kNamingSigmaPx * kNamingSigmaPx * Eigen::Matrix2d::Identity(), 0.0};
  return nameByPrediction({predictions.data(), static_cast<std::size_t>(markers.count())}, observation,
                          kNamingGateChi2);
}

/// The helicopter's pose from what the calibrated cameras see in one frame. How a tracker predicts is not
/// under study: balls are named near their true places, and the fit starts there.
PoseFit fitFrame(const CameraModel& camera, const CalibrationFieldOptions& options,
                 const std::array<Eye, 2>& eyes, const std::array<Look, 2>& looks,
                 const RigidTransform& truth, std::array<NamedView, 2>& views) {
  for (std::size_t c = 0; c < 2; ++c)
    views[c] = {&camera, eyes[c].pose(), &looks[c].observation,
                namesNear(camera, options.markers, eyes[c].pose(), truth, looks[c].observation)};
  PoseFit fit = fitPose(views, options.markers, truth, kRobustSigmas * options.sigma_px, 15,
                        kInlierSigmas * options.sigma_px);
  fit.ok = fit.ok && fit.inliers >= kFewestInliers;
  return fit;
}

RigMoment::View namedView(const Look& look, const Names& names, int balls, double sigma_px) {
  RigMoment::View view;
  view.variance = static_cast<float>(sigma_px * sigma_px);
  for (std::size_t m = 0; m < static_cast<std::size_t>(balls); ++m) {
    if (names[m] < 0) continue;
    view.seen.set(m);
    view.pixels[m] = look.observation.centroids[static_cast<std::size_t>(names[m])].pixel.cast<float>();
  }
  return view;
}

std::span<const MarkerId> seenBy(const Look& look) {
  return {look.truth.data(), static_cast<std::size_t>(look.observation.count)};
}

std::span<const MarkerId> trulySeenBy(const Look& look) {
  return {look.not_thrown.data(), look.not_thrown_count};
}

/// One frame's share of a bound: `seen` by the learner and by the two that know their places.
void addToBound(const CameraModel& camera, const RigidTransform& learner, const std::array<Eye, 2>& eyes,
                const CalibrationFieldOptions& options, const RigidTransform& truth,
                const std::array<std::span<const MarkerId>, 3>& seen, CramerRaoBound& bound) {
  Matrix6d information = Matrix6d::Zero();
  for (std::size_t c = 0; c < 2; ++c)
    information += poseInformation(camera, eyes[c].pose(), options.markers, seen[c], truth, options.sigma_px);
  bound.add(camera, learner, options.markers, seen[2], truth, information, options.sigma_px);
}

}  // namespace

CalibrationField simulateCalibrationField(std::uint64_t seed, const CalibrationFieldOptions& options) {
  const Random random(seed);
  Random places = random.fork(1);
  CalibrationField field;
  field.camera = CameraModel(640, 480, 567.6, 567.6, 319.5, 239.5);
  std::array<Eye, 2> eyes{Eye(field.camera, placeCamera(-kPi / 4, places), random.fork(2)),
                          Eye(field.camera, placeCamera(kPi / 4, places), random.fork(3))};
  for (std::size_t c = 0; c < 2; ++c) field.known_cameras[c] = eyes[c].pose();
  field.camera_from_world = placeCamera(kPi, places);
  Eye learner(field.camera, field.camera_from_world, random.fork(4));
  Vector6d off;
  off.head<3>() = options.guess_rotation * randomDirection(places);
  off.tail<3>() = options.guess_position * randomDirection(places);
  field.guess = perturbCamera(field.camera_from_world, off);

  CramerRaoBound bound, true_bound;
  for (const RigidTransform& truth : fly(options, random.fork(5))) {
    CalibrationField::Frame& frame = field.frames.emplace_back();
    const std::array<Look, 2> looks{eyes[0].look(truth, options), eyes[1].look(truth, options)};
    const Look own = learner.look(truth, options);
    frame.observation = own.observation;
    frame.observation.exposure = fromSeconds(static_cast<double>(field.frames.size()) / options.rate_hz);
    for (std::size_t i = 0; i < static_cast<std::size_t>(own.observation.count); ++i)
      frame.labelled[i] = {own.truth[i], own.observation.centroids[i].pixel,
                           own.observation.centroids[i].covariance};
    std::array<NamedView, 2> views;
    const PoseFit fit = fitFrame(field.camera, options, eyes, looks, truth, views);
    for (std::size_t c = 0; c < 2; ++c)
      frame.known_views[c] = namedView(looks[c], views[c].names, options.markers.count(), options.sigma_px);
    frame.has_pose = fit.ok;
    frame.world_from_body = fit.world_from_body;
    frame.true_world_from_body = truth;
    if (fit.ok) frame.pose_covariance = options.sigma_px * options.sigma_px * fit.information.inverse();
    addToBound(field.camera, field.camera_from_world, eyes, options, truth,
               {seenBy(looks[0]), seenBy(looks[1]), seenBy(own)}, bound);
    addToBound(field.camera, field.camera_from_world, eyes, options, truth,
               {trulySeenBy(looks[0]), trulySeenBy(looks[1]), trulySeenBy(own)}, true_bound);
    if (const auto now = bound.bound()) frame.bound = *now;
    if (const auto now = true_bound.bound()) frame.true_bound = *now;
  }
  return field;
}

}  // namespace helical
