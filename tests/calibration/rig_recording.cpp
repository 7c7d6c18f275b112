#include "tests/calibration/rig_recording.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "engine/geometry/rotation.h"

namespace helical {
namespace {

RigidTransform lookAt(const Eigen::Vector3d& from, const Eigen::Vector3d& at) {
  const Eigen::Vector3d forward = (at - from).normalized();
  const Eigen::Vector3d right = forward.cross(Eigen::Vector3d::UnitZ()).normalized();
  Eigen::Matrix3d rotation;
  rotation << right.transpose(), forward.cross(right).transpose(), forward.transpose();
  const Eigen::Quaterniond q(rotation);
  return {q, -(q * from)};
}

std::vector<RigCamera> makeCameras(int count, Random& random) {
  std::vector<RigCamera> cameras;
  for (int i = 0; i < count; ++i) {
    const double angle = 2.0 * kPi * (i + random.uniform(-0.1, 0.1)) / count;
    const Eigen::Vector3d from(3.0 * std::cos(angle), 3.0 * std::sin(angle), random.uniform(1.0, 2.0));
    RigCamera camera;
    camera.label = std::to_string(i + 1);
    camera.model = CameraModel(640, 480, random.uniform(500, 600), random.uniform(500, 600), 322.0, 236.0,
                               {random.uniform(-0.1, 0.1), 0.02, 1e-3, -1e-3, 0.0});
    camera.camera_from_world = lookAt(from, {0.0, 0.0, 0.6});
    cameras.push_back(camera);
  }
  return cameras;
}

/// A hand's motion through the middle of the space.
Eigen::Vector3d handAt(double t) {
  return {0.7 * std::sin(1.3 * t) + 0.2 * std::sin(3.1 * t), 0.7 * std::cos(1.7 * t),
          0.7 + 0.4 * std::sin(0.9 * t + 1.0)};
}

RigidTransform wristAt(double t, const Eigen::Vector3d& reach) {
  const Eigen::Vector3d middle(0.0, 0.0, 0.7);
  return {expSO3({0.9 * std::sin(0.8 * t), 0.9 * std::sin(1.1 * t + 2.0), 1.5 * std::sin(0.5 * t)}),
          middle + reach.cwiseProduct(handAt(t) - middle)};
}

/// Points at a time; `in_body` where the recording has body coordinates.
struct Target {
  std::vector<Eigen::Vector3d> in_body;
  bool named = false, body = false, moves = true;
};

MadeRecording record(const Target& target, const RecordingOptions& options, std::uint64_t seed) {
  Random random(seed);
  MadeRecording made;
  made.cameras = makeCameras(options.cameras, random);
  if (target.named)
    for (std::size_t m = 0; m < target.in_body.size(); ++m)
      made.rows.markers.push_back("m" + std::to_string(m));
  else
    made.rows.markers.emplace_back();
  std::vector<double> phase;
  for (int c = 0; c < options.cameras; ++c)
    phase.push_back(options.together ? 0.0 : random.uniform(0.0, 1.0));
  const int frames = static_cast<int>(options.duration_s * options.rate_hz);
  for (int k = 0; k < frames; ++k)
    for (int c = 0; c < options.cameras; ++c) {
      const double shift = options.jitter_s > 0.0 ? random.uniform(-options.jitter_s, options.jitter_s) : 0.0;
      const double time = (k + phase[static_cast<std::size_t>(c)]) / options.rate_hz + shift;
      const double late = options.late_s.empty() ? 0.0 : options.late_s[static_cast<std::size_t>(c)];
      const RigidTransform pose = target.moves ? wristAt(time + late, options.reach) : RigidTransform{};
      const RigCamera& camera = made.cameras[static_cast<std::size_t>(c)];
      for (std::size_t m = 0; m < target.in_body.size(); ++m) {
        const auto pixel = camera.model.project(*camera.camera_from_world * (pose * target.in_body[m]));
        const Eigen::Vector2d noise(random.normal(), random.normal());
        const bool lost = random.uniform() < options.dropout, thrown = random.uniform() < options.outliers;
        const Eigen::Vector2d aside(random.uniform(-80, 80), random.uniform(-80, 80));
        if (!pixel || lost || !camera.model.contains(*pixel)) continue;
        PointRow row;
        row.time_s = time;
        row.camera = c;
        row.marker = target.named ? static_cast<std::int32_t>(m) : 0;
        row.pixel = *pixel + options.sigma_px * noise;
        if (thrown) row.pixel += aside;
        made.rows.rows.push_back(row);
        if (target.body) made.rows.in_body.push_back(target.in_body[m]);
      }
    }
  return made;
}

}  // namespace

std::vector<RigCamera> MadeRecording::unposed() const {
  std::vector<RigCamera> out = cameras;
  for (RigCamera& camera : out) camera.camera_from_world.reset();
  return out;
}

MadeRecording wavedLight(const RecordingOptions& options, std::uint64_t seed) {
  return record({{Eigen::Vector3d::Zero()}}, options, seed);
}

MadeRecording namedMarkers(const RecordingOptions& options, std::uint64_t seed) {
  Target target;
  target.named = true;
  target.in_body = {{0, 0, 0}, {0.3, 0, 0}, {0, 0.25, 0}, {0, 0, 0.2}, {-0.2, -0.1, 0.1}};
  return record(target, options, seed);
}

MadeRecording stillMarkers(const RecordingOptions& options, std::uint64_t seed) {
  Random random(seed + 1000);
  Target target;
  target.named = true;
  target.moves = false;
  for (int i = 0; i < 60; ++i)
    target.in_body.emplace_back(random.uniform(-0.9, 0.9), random.uniform(-0.9, 0.9),
                                random.uniform(0.0, 1.3));
  RecordingOptions short_one = options;
  short_one.duration_s = 0.5;
  return record(target, short_one, seed);
}

MadeRecording wavedBoard(const RecordingOptions& options, std::uint64_t seed) {
  Target target;
  target.body = true;
  for (int i = 0; i < 24; ++i) target.in_body.emplace_back(0.06 * (i % 6), 0.06 * (i / 6), 0.0);
  return record(target, options, seed);
}

PoseErrors poseErrors(const std::vector<RigCamera>& truth,
                      const std::vector<std::optional<RigidTransform>>& solved, bool scaled) {
  Eigen::Matrix3Xd from(3, static_cast<Eigen::Index>(truth.size())), to = from;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    if (!solved[i]) return {180.0, 1e9};
    from.col(static_cast<Eigen::Index>(i)) = solved[i]->inverseTranslation();
    to.col(static_cast<Eigen::Index>(i)) = truth[i].camera_from_world->inverseTranslation();
  }
  const Eigen::Matrix4d transform = Eigen::umeyama(from, to, scaled);
  const double scale = transform.topLeftCorner<3, 1>().norm();
  const Eigen::Quaterniond turn(Eigen::Matrix3d(transform.topLeftCorner<3, 3>() / scale));
  PoseErrors errors;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const Eigen::Quaterniond rotation = solved[i]->rotation * turn.conjugate();
    errors.degrees =
        std::max(errors.degrees, toDegrees(rotation.angularDistance(truth[i].camera_from_world->rotation)));
    const Eigen::Vector4d moved = transform * solved[i]->inverseTranslation().homogeneous();
    errors.metres =
        std::max(errors.metres, (moved.head<3>() - truth[i].camera_from_world->inverseTranslation()).norm());
  }
  return errors;
}

}  // namespace helical
