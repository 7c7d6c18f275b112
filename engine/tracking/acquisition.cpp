#include "engine/tracking/acquisition.h"

#include <algorithm>
#include <cmath>

#include "engine/correspondence/convex_hull.h"
#include "engine/geometry/planar_pnp.h"
#include "engine/geometry/rotation.h"

namespace helical {
namespace {

constexpr TimeNs kSimultaneous = 20 * kNanosecondsPerMillisecond;
constexpr double kInlierPx = 3.0;
constexpr double kCoarseGatePx = 40.0;
constexpr double kFineGatePx = 10.0;
constexpr double kPnpLimitPx = 4.0;
constexpr double kExplainedShare = 0.7;
constexpr int kFewestInliers = 4;
constexpr double kTiltSigma = 0.3;          // rad
constexpr double kDistinctDistance = 0.05;  // m
constexpr double kDistinctAngle = 0.35;     // rad
constexpr double kClearLead = 6.0;          // cost by which the best pose must lead any other
constexpr double kBeyondLead = 2.0;  // misfit by which a pose beyond the yaw range shows the others wrong
constexpr double kYawStep = toRadians(15.0);

/// What the prior says against a pose, in the units of squared pixels over one pixel's variance.
double unlikeliness(const RigidTransform& pose, const PosePrior& prior) {
  const double turn =
      wrapAngle(yawOf(pose.rotation) - yawOf(prior.world_from_body.rotation)) / prior.yaw_sigma;
  const double tilt = tiltOf(pose.rotation) / kTiltSigma;
  return turn * turn + tilt * tilt;
}

bool distinct(const RigidTransform& a, const RigidTransform& b) {
  return (a.translation - b.translation).norm() > kDistinctDistance ||
         a.rotation.angularDistance(b.rotation) > kDistinctAngle;
}

/// But for the heading.
bool within(const RigidTransform& pose, const PosePrior& prior) {
  return (pose.translation - prior.world_from_body.translation).norm() <= prior.position_radius &&
         tiltOf(pose.rotation) <= prior.tilt_limit;
}

bool headsWithin(const RigidTransform& pose, const PosePrior& prior) {
  return std::abs(wrapAngle(yawOf(pose.rotation) - yawOf(prior.world_from_body.rotation))) <= prior.yaw_range;
}

}  // namespace

struct Acquisition::Best {
  PoseFit fit;
  double cost = 1e300;
  double misfit = 1e300;     ///< the cost without what the prior says
  double runner_up = 1e300;  ///< cost of the best pose that is distinctly different
  double beyond = 1e300;     ///< misfit of the best pose that heads out of the yaw range

  void offer(const PoseFit& other, double other_misfit, double other_cost) {
    const bool different = cost < 1e300 && distinct(other.world_from_body, fit.world_from_body);
    if (other_cost < cost) {
      if (different) runner_up = std::min(runner_up, cost);
      fit = other;
      misfit = other_misfit;
      cost = other_cost;
    } else if (different) {
      runner_up = std::min(runner_up, other_cost);
    }
  }
};

Acquisition::Acquisition(const MarkerLayout& markers, std::vector<CameraModel> cameras)
    : markers_(markers), cameras_(std::move(cameras)) {}

void Acquisition::correct(const MarkerLayout& markers, std::span<const CameraModel> cameras) {
  markers_ = markers;
  std::copy(cameras.begin(), cameras.end(), cameras_.begin());
}

void Acquisition::add(const Observation& observation) {
  const auto index = static_cast<std::size_t>(observation.camera.index());
  newest_[index] = observation;
  seen_[index] = true;
}

std::optional<PoseFit> Acquisition::attempt(TimeNs time, std::span<const CameraEstimate> cameras,
                                            std::span<const bool> usable, const PosePrior& prior) {
  view_count_ = possible_ = 0;
  for (std::size_t c = 0; c < cameras_.size(); ++c) {
    if (!seen_[c] || !usable[c] || std::abs(time - newest_[c].exposure) > kSimultaneous) continue;
    if (newest_[c].count == 0) continue;
    NamedView& view = views_[static_cast<std::size_t>(view_count_++)];
    view.camera = &cameras_[c];
    view.camera_from_world = cameras[c].camera_from_world;
    view.observation = &newest_[c];
    possible_ += std::min(newest_[c].count, markers_.count());
  }
  if (possible_ < kFewestInliers) return std::nullopt;

  Best best;
  consider(prior.world_from_body, prior, best);
  // All around: a helicopter that was put down the wrong way must not pass for a badly fitting right way.
  for (double turn = kYawStep; turn <= kPi; turn += kYawStep) {
    for (const double sign : {-1.0, 1.0}) {
      RigidTransform turned = prior.world_from_body;
      turned.rotation = expSO3({0.0, 0.0, sign * turn}) * turned.rotation;
      consider(turned, prior, best);
    }
  }
  for (int v = 0; v < view_count_; ++v) considerHull(views_[static_cast<std::size_t>(v)], prior, best);

  const int needed = std::max(kFewestInliers, static_cast<int>(std::ceil(kExplainedShare * possible_)));
  if (best.fit.inliers < needed || best.runner_up - best.cost < kClearLead ||
      best.misfit - best.beyond > kBeyondLead)
    return std::nullopt;
  return best.fit;
}

void Acquisition::name(NamedView& view, const RigidTransform& pose, double gate_px) const {
  std::array<MarkerPrediction, kMaxMarkers> predictions;
  for (int m = 0; m < markers_.count(); ++m) {
    MarkerPrediction& prediction = predictions[static_cast<std::size_t>(m)];
    const Eigen::Vector3d in_camera = view.camera_from_world * (pose * markers_.inBody(markerId(m)));
    const auto pixel = view.camera->project(in_camera);
    if (!pixel || !view.camera->contains(*pixel)) continue;
    prediction.visible = true;
    prediction.pixel = *pixel;
    prediction.radius_px = view.camera->fx() * markers_.radius() / in_camera.z();
  }
  view.names = nameByPrediction({predictions.data(), static_cast<std::size_t>(markers_.count())},
                                *view.observation, gate_px * gate_px);
}

void Acquisition::consider(const RigidTransform& hypothesis, const PosePrior& prior, Best& best) {
  const std::span<NamedView> views(views_.data(), static_cast<std::size_t>(view_count_));
  for (auto& view : views) name(view, hypothesis, kCoarseGatePx);
  PoseFit fit = fitPose(views, markers_, hypothesis, 20.0, 6, kInlierPx);
  if (!fit.ok && fit.named < 3) return;
  for (auto& view : views) name(view, fit.world_from_body, kFineGatePx);
  fit = fitPose(views, markers_, fit.world_from_body, kInlierPx, 8, kInlierPx);
  if (!fit.ok || !within(fit.world_from_body, prior)) return;
  const double misfit =
      2.0 * fit.inliers * fit.rms_px * fit.rms_px + (possible_ - fit.inliers) * kInlierPx * kInlierPx;
  if (headsWithin(fit.world_from_body, prior))
    best.offer(fit, misfit, misfit + unlikeliness(fit.world_from_body, prior));
  else
    best.beyond = std::min(best.beyond, misfit);
}

void Acquisition::considerHull(const NamedView& view, const PosePrior& prior, Best& best) {
  const Observation observation = *view.observation;
  std::array<Eigen::Vector2d, kMaxCentroids> pixels;
  for (int c = 0; c < observation.count; ++c)
    pixels[static_cast<std::size_t>(c)] = observation.centroids[static_cast<std::size_t>(c)].pixel;
  const HullOrder seen = convexHull({pixels.data(), static_cast<std::size_t>(observation.count)});

  std::array<Eigen::Vector2d, kMaxMarkers> plane;
  for (int m = 0; m < markers_.count(); ++m)
    plane[static_cast<std::size_t>(m)] = markers_.inBody(markerId(m)).head<2>();
  const HullOrder layout = convexHull({plane.data(), static_cast<std::size_t>(markers_.count())});
  const int n = layout.count;
  if (n < 4 || seen.count != n) return;

  // A camera above the markers sees them turn the other way round than the body's x-y plane does: y points
  // down.
  PosePrior wider = prior;
  wider.position_radius += 0.2;
  wider.tilt_limit += 0.2;
  const RigidTransform world_from_camera = view.camera_from_world.inverse();
  const bool from_above = world_from_camera.translation.z() > prior.world_from_body.translation.z();
  for (int shift = 0; shift < n; ++shift) {
    std::array<Eigen::Vector3d, kMaxMarkers> points;
    std::array<Eigen::Vector2d, kMaxMarkers> images;
    for (int k = 0; k < n; ++k) {
      const int at = from_above ? (shift + n - k) % n : (shift + k) % n;
      points[static_cast<std::size_t>(k)] =
          markers_.inBody(markerId(layout.index[static_cast<std::size_t>(at)]));
      images[static_cast<std::size_t>(k)] = pixels[seen.index[static_cast<std::size_t>(k)]];
    }
    const PlanarPoses poses = solvePlanarPnp(*view.camera, {points.data(), static_cast<std::size_t>(n)},
                                             {images.data(), static_cast<std::size_t>(n)});
    for (int p = 0; p < poses.count; ++p) {
      const PlanarPose& pose = poses.poses[static_cast<std::size_t>(p)];
      if (pose.rms_px > kPnpLimitPx) continue;
      const RigidTransform hypothesis = world_from_camera * pose.camera_from_body;
      if (within(hypothesis, wider)) consider(hypothesis, prior, best);
    }
  }
}

}  // namespace helical
