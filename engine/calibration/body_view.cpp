#include "engine/calibration/body_view.h"

#include <Eigen/Cholesky>
#include <algorithm>

#include "engine/calibration/camera_perturbation.h"
#include "engine/geometry/camera_perturbation.h"

namespace helical {
namespace {

constexpr double kSlackPx = 0.2;  // of offsets that stay from frame to frame: no number of frames tells them
constexpr double kLargestSeedRmsPx = 4.0;
constexpr double kRobust2 = 25.0;      // squared sigmas beyond which a ball counts less
constexpr double kPruneCost = 40.0;
constexpr int kFewestFrames = 8;
constexpr int kIterations = 3;
constexpr int kFewestBalls = 4;
constexpr int kMostMisfits = 15;
constexpr double kSameRotation = 0.01, kSamePosition = 0.01;

double robustCost(double squared) {
  return squared <= kRobust2 ? squared : kRobust2 * (2.0 - kRobust2 / squared);
}

}  // namespace

BodyView::BodyView(const CameraModel& camera, const MarkerLayout& markers)
    : camera_(camera), markers_(markers), seeds_(camera_, markers), tracks_({}, markers.count()) {
  pixels_.fill(Eigen::Vector2d::Zero());
}

void BodyView::forget() {
  tracks_.forget();
  count_ = frames_ = misfits_ = 0;
  known_ = false;
  seen_.reset();
}

void BodyView::seek(const Observation& observation) {
  if (observation.count != markers_.count() || markers_.count() < kFewestBalls) return;
  std::array<Eigen::Vector2d, kMaxMarkers> pixels;
  Names as_they_stand;
  as_they_stand.fill(-1);
  for (int c = 0; c < observation.count; ++c) {
    pixels[static_cast<std::size_t>(c)] = observation.centroids[static_cast<std::size_t>(c)].pixel;
    as_they_stand[static_cast<std::size_t>(c)] = c;
  }
  for (seeds_.start({pixels.data(), static_cast<std::size_t>(observation.count)}, ViewSide::kEither);
       !seeds_.done();) {
    const auto found = seeds_.next(kLargestSeedRmsPx);
    if (!found) continue;
    for (int p = 0; p < found->poses.count; ++p) {
      const PlanarPose& pose = found->poses.poses[static_cast<std::size_t>(p)];
      if (pose.rms_px > kLargestSeedRmsPx || count_ == static_cast<int>(hypotheses_.size())) continue;
      Hypothesis& fresh = hypotheses_[static_cast<std::size_t>(count_++)];
      fresh = {};
      std::copy_n(found->labelling.marker.begin(), kMaxMarkers, fresh.marker_of_track.begin());
      fresh.camera_from_body = pose.camera_from_body;
    }
  }
  if (count_ > 0) tracks_.restart(observation, as_they_stand);
}

BodyView::Fit BodyView::fit(const Hypothesis& hypothesis, const Observation& observation,
                            const Names& centroid_of_track) const {
  Fit result;
  result.camera_from_body = hypothesis.camera_from_body;
  for (int iteration = 0; iteration <= kIterations; ++iteration) {
    Matrix6d hessian = 1e-9 * Matrix6d::Identity();
    Vector6d gradient = Vector6d::Zero();
    result.cost = 0.0;
    result.inliers = 0;
    for (int track = 0; track < markers_.count(); ++track) {
      const int centroid = centroid_of_track[static_cast<std::size_t>(track)];
      if (centroid < 0) continue;
      const Eigen::Vector3d& ball =
          markers_.inBody(MarkerId{hypothesis.marker_of_track[static_cast<std::size_t>(track)]});
      const auto seen = projectMarker(camera_, result.camera_from_body, {}, ball);
      if (!seen) {
        result.cost += 2.0 * kRobust2;
        continue;
      }
      const Eigen::Vector2d residual =
          seen->pixel - observation.centroids[static_cast<std::size_t>(centroid)].pixel;
      const double squared = residual.squaredNorm() / variance_;
      const double ratio = kRobust2 / std::max(squared, kRobust2);
      result.cost += robustCost(squared);
      result.inliers += squared <= kRobust2;
      hessian.noalias() += ratio * ratio * seen->d_camera.transpose() * seen->d_camera;
      gradient.noalias() += ratio * ratio * seen->d_camera.transpose() * residual;
    }
    if (iteration == kIterations) break;
    const Vector6d step = -hessian.ldlt().solve(gradient);
    if (!step.allFinite() || step.norm() > 1.0) break;
    result.camera_from_body = perturbCamera(result.camera_from_body, step);
  }
  return result;
}

void BodyView::step(const Observation& observation) {
  known_ = false;
  if (observation.count == 0) return;
  const double sigma2 = 0.5 * observation.centroids[0].covariance.trace();
  variance_ = sigma2 + kSlackPx * kSlackPx;
  if (tracks_.lost() || count_ == 0) {
    forget();
    seek(observation);
    return;
  }
  const Names centroid_of_track = tracks_.follow(observation);
  if (tracks_.lost()) return;
  int followed = 0;
  for (int track = 0; track < markers_.count(); ++track)
    followed += centroid_of_track[static_cast<std::size_t>(track)] >= 0;
  if (followed < kFewestBalls) return;
  int best_inliers = 0;
  for (int i = 0; i < count_; ++i) {
    Hypothesis& each = hypotheses_[static_cast<std::size_t>(i)];
    const Fit now = fit(each, observation, centroid_of_track);
    each.camera_from_body = now.camera_from_body;
    each.cost += now.cost;
    best_inliers = std::max(best_inliers, now.inliers);
  }
  ++frames_;
  prune();
  misfits_ = best_inliers < kFewestBalls ? misfits_ + 1 : std::max(0, misfits_ - 1);
  if (misfits_ > kMostMisfits) return forget();
  known_ = count_ == 1 && frames_ >= kFewestFrames && best_inliers >= kFewestBalls;
  if (known_) takeNames(observation, centroid_of_track);
  variance_ = sigma2;
}

void BodyView::prune() {
  const auto end = hypotheses_.begin() + count_;
  std::sort(hypotheses_.begin(), end, [](const Hypothesis& a, const Hypothesis& b) { return a.cost < b.cost; });
  int kept = 0;
  for (int i = 0; i < count_; ++i) {
    const Hypothesis& each = hypotheses_[static_cast<std::size_t>(i)];
    if (frames_ >= kFewestFrames && each.cost > hypotheses_[0].cost + kPruneCost) break;
    const bool twin = std::any_of(hypotheses_.begin(), hypotheses_.begin() + kept, [&](const Hypothesis& other) {
      const Vector6d apart = cameraPerturbation(other.camera_from_body, each.camera_from_body);
      return other.marker_of_track == each.marker_of_track && apart.head<3>().norm() < kSameRotation &&
             apart.tail<3>().norm() < kSamePosition;
    });
    if (!twin) hypotheses_[static_cast<std::size_t>(kept++)] = each;
  }
  count_ = kept;
}

void BodyView::takeNames(const Observation& observation, const Names& centroid_of_track) {
  seen_.reset();
  for (int track = 0; track < markers_.count(); ++track) {
    const int centroid = centroid_of_track[static_cast<std::size_t>(track)];
    if (centroid < 0) continue;
    const std::size_t marker = hypotheses_[0].marker_of_track[static_cast<std::size_t>(track)];
    seen_.set(marker);
    pixels_[marker] = observation.centroids[static_cast<std::size_t>(centroid)].pixel;
  }
}

}  // namespace helical
