#include "engine/calibration/rig/point_structure.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "engine/calibration/rig/quantile.h"

namespace helical {
namespace {

constexpr double kSmallestSine = 0.01;  // of the angle between two rays that place a point
constexpr double kMedianToSigma = 1.4826;
constexpr double kLeastSigmaPx = 0.01;

struct Ray {
  Eigen::Vector3d origin, direction;
};

std::optional<Eigen::Vector3d> meet(const Ray& a, const Ray& b) {
  if (a.direction.cross(b.direction).norm() < kSmallestSine) return std::nullopt;
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (const Ray* ray : {&a, &b}) {
    const Eigen::Matrix3d across = Eigen::Matrix3d::Identity() - ray->direction * ray->direction.transpose();
    sum += across;
    right += across * ray->origin;
  }
  return sum.inverse() * right;
}

/// The sightings of one item.
class PointPlacer {
 public:
  PointPlacer(const RigState& state, std::span<const RigCamera> cameras, std::span<Sighting> sightings,
              double tolerance_px)
      : state_(state), cameras_(cameras), sightings_(sightings), tolerance2_(tolerance_px * tolerance_px) {
    for (const Sighting& s : sightings) {
      const auto& pose = state.camera_from_world[static_cast<std::size_t>(s.camera)];
      if (!pose) continue;
      seen_.push_back(&s);
      rays_.push_back(
          {pose->inverseTranslation(), (pose->rotation.conjugate() * s.bearing.homogeneous()).normalized()});
    }
  }

  std::optional<Eigen::Vector3d> place(const std::optional<Eigen::Vector3d>& before) {
    if (before) consider(*before);
    // A point that all agree on needs no search.
    if (best_inliers_ < static_cast<int>(rays_.size()))
      for (std::size_t i = 0; i < rays_.size(); ++i)
        for (std::size_t j = i + 1; j < rays_.size(); ++j)
          if (const auto point = meet(rays_[i], rays_[j])) consider(*point);
    const bool placed = best_inliers_ >= 2;
    for (Sighting& s : sightings_) s.inlier = placed && error2(s, best_) <= tolerance2_;
    return placed ? std::optional(best_) : std::nullopt;
  }

 private:
  double error2(const Sighting& s, const Eigen::Vector3d& point) const {
    const auto camera = static_cast<std::size_t>(s.camera);
    if (!state_.camera_from_world[camera]) return 1e12;
    const auto pixel = cameras_[camera].model.project(*state_.camera_from_world[camera] * point);
    return pixel ? (*pixel - s.pixel).squaredNorm() : 1e12;
  }

  void consider(const Eigen::Vector3d& point) {
    int inliers = 0;
    double cost = 0.0;
    for (const Sighting* s : seen_) {
      const double e = error2(*s, point);
      inliers += e <= tolerance2_ ? 1 : 0;
      cost += std::min(e, tolerance2_);
    }
    if (cost >= best_cost_) return;
    best_cost_ = cost;
    best_inliers_ = inliers;
    best_ = point;
  }

  const RigState& state_;
  std::span<const RigCamera> cameras_;
  std::span<Sighting> sightings_;
  double tolerance2_;
  std::vector<const Sighting*> seen_;
  std::vector<Ray> rays_;
  Eigen::Vector3d best_ = Eigen::Vector3d::Zero();
  int best_inliers_ = 0;
  double best_cost_ = 1e300;
};

}  // namespace

void placePoints(RigState& state, std::span<const RigCamera> cameras, SightingTable& table,
                 double tolerance_px) {
  const auto starts = itemStarts(table);
  for (std::size_t i = 0; i < static_cast<std::size_t>(table.items); ++i) {
    const auto sightings = std::span(table.sightings).subspan(starts[i], starts[i + 1] - starts[i]);
    state.points[i] = PointPlacer(state, cameras, sightings, tolerance_px).place(state.points[i]);
  }
}

double sightingSigma(const RigState& state, std::span<const RigCamera> cameras, const SightingTable& table) {
  std::vector<double> errors;
  std::vector<bool> used(static_cast<std::size_t>(table.items), false);
  for (const Sighting& s : table.sightings) {
    if (!s.inlier) continue;
    const auto r = sightingResidual(state, cameras, table, s);
    if (!r) continue;
    errors.push_back(std::abs(r->x()));
    errors.push_back(std::abs(r->y()));
    used[static_cast<std::size_t>(s.item)] = true;
  }
  if (errors.empty()) return kLeastSigmaPx;
  const double items = static_cast<double>(std::count(used.begin(), used.end(), true));
  const double parameters = items * (table.kind == TargetKind::kBody ? 6.0 : 3.0);
  const double measured = static_cast<double>(errors.size());
  const double freedom = std::max(0.1 * measured, measured - parameters);
  return std::max(kLeastSigmaPx, kMedianToSigma * quantileOf(errors, 0.5) * std::sqrt(measured / freedom));
}

void gateSightings(RigState& state, std::span<const RigCamera> cameras, SightingTable& table,
                   double tolerance_px, int fewest) {
  const auto starts = itemStarts(table);
  for (std::size_t i = 0; i < static_cast<std::size_t>(table.items); ++i) {
    const auto sightings = std::span(table.sightings).subspan(starts[i], starts[i + 1] - starts[i]);
    int inliers = 0;
    for (Sighting& s : sightings) {
      const auto r = sightingResidual(state, cameras, table, s);
      s.inlier = r && r->norm() <= tolerance_px;
      inliers += s.inlier ? 1 : 0;
    }
    if (inliers >= fewest) continue;
    for (Sighting& s : sightings) s.inlier = false;
    if (table.kind != TargetKind::kBody) state.points[i].reset();
  }
}

}  // namespace helical
