#include "engine/calibration/rig/chain_points.h"

#include <algorithm>
#include <cmath>

#include "engine/calibration/rig/pair_geometry.h"
#include "engine/calibration/rig/point_structure.h"
#include "engine/calibration/rig/rig_bundle.h"
#include "engine/geometry/camera_resection.h"

namespace helical {
namespace {

constexpr std::size_t kFirstPairs = 4;
constexpr double kWellExplained = 0.9;  // share of sightings, after which no other first pair is tried
constexpr double kEnoughParallaxDeg = 20.0;
constexpr int kFewestForACamera = 10;
constexpr double kFewestInlierShare = 0.25;
constexpr std::size_t kMostPairPoints = 1500;

struct Pair {
  std::size_t a = 0, b = 0;
  PairGeometry geometry;
  double score = 0.0;
};

class Chain {
 public:
  Chain(std::span<const RigCamera> cameras, SightingTable& table, double tolerance_px)
      : cameras_(cameras), table_(table), tolerance_px_(tolerance_px), starts_(itemStarts(table)) {}

  std::vector<Pair> pairs(const ProgressCallback& progress) const {
    std::vector<Pair> found;
    const std::size_t n = cameras_.size();
    for (std::size_t a = 0, done = 0; a < n; ++a) {
      for (std::size_t b = a + 1; b < n; ++b, ++done) {
        if (progress) progress(0.3 * static_cast<double>(done) / static_cast<double>(n * (n - 1) / 2));
        std::vector<Eigen::Vector2d> in_a, in_b;
        shared(a, b, in_a, in_b);
        const double focal = std::min(cameras_[a].model.fx(), cameras_[b].model.fx());
        const auto geometry = relatePair(in_a, in_b, 0.5 * tolerance_px_ / focal);
        if (!geometry) continue;
        const double parallax = std::min(geometry->parallax_deg, kEnoughParallaxDeg) / kEnoughParallaxDeg;
        found.push_back({a, b, *geometry, geometry->inliers * parallax});
      }
    }
    std::stable_sort(found.begin(), found.end(),
                     [](const Pair& p, const Pair& q) { return p.score > q.score; });
    return found;
  }

  RigState grow(const Pair& first) {
    RigState state;
    state.camera_from_world.resize(cameras_.size());
    state.points.resize(static_cast<std::size_t>(table_.items));
    state.world_from_body.resize(state.points.size());
    state.fixed.assign(cameras_.size(), false);
    state.camera_from_world[first.a] = RigidTransform{};
    state.camera_from_world[first.b] = first.geometry.b_from_a;
    settle(state);
    std::vector<bool> tried(cameras_.size(), false);
    while (const auto next = nextCamera(state, tried)) {
      tried[*next] = true;
      if (!addCamera(state, *next)) continue;
      settle(state);
      std::fill(tried.begin(), tried.end(), false);
    }
    return state;
  }

  /// Cauchy's loss first, at the tolerance's scale: the first pose is only as good as a few points.
  void settle(RigState& state) {
    for (int round = 0; round < 2; ++round) {
      placePoints(state, cameras_, table_, (round == 0 ? 3.0 : 1.5) * tolerance_px_);
      adjustBundle(state, cameras_, table_, {0.3 * tolerance_px_, 30, false});
    }
    placePoints(state, cameras_, table_, tolerance_px_);
  }

  int explained() const {
    return static_cast<int>(std::count_if(table_.sightings.begin(), table_.sightings.end(),
                                          [](const Sighting& s) { return s.inlier; }));
  }

 private:
  void shared(std::size_t a, std::size_t b, std::vector<Eigen::Vector2d>& in_a,
              std::vector<Eigen::Vector2d>& in_b) const {
    for (std::size_t i = 0; i + 1 < starts_.size(); ++i) {
      const Sighting *from_a = nullptr, *from_b = nullptr;
      for (std::size_t k = starts_[i]; k < starts_[i + 1]; ++k) {
        if (static_cast<std::size_t>(table_.sightings[k].camera) == a) from_a = &table_.sightings[k];
        if (static_cast<std::size_t>(table_.sightings[k].camera) == b) from_b = &table_.sightings[k];
      }
      if (from_a == nullptr || from_b == nullptr) continue;
      in_a.push_back(from_a->bearing);
      in_b.push_back(from_b->bearing);
    }
    const std::size_t by = in_a.size() / kMostPairPoints + 1;
    for (std::vector<Eigen::Vector2d>* bearings : {&in_a, &in_b}) {
      std::size_t kept = 0;
      for (std::size_t i = 0; i < bearings->size(); i += by) (*bearings)[kept++] = (*bearings)[i];
      bearings->resize(kept);
    }
  }

  std::optional<std::size_t> nextCamera(const RigState& state, const std::vector<bool>& tried) const {
    std::vector<int> seen(cameras_.size(), 0);
    for (const Sighting& s : table_.sightings)
      if (state.points[static_cast<std::size_t>(s.item)]) ++seen[static_cast<std::size_t>(s.camera)];
    std::optional<std::size_t> best;
    for (std::size_t c = 0; c < cameras_.size(); ++c)
      if (!state.camera_from_world[c] && !tried[c] && seen[c] >= kFewestForACamera &&
          (!best || seen[c] > seen[*best]))
        best = c;
    return best;
  }

  bool addCamera(RigState& state, std::size_t camera) const {
    std::vector<Eigen::Vector3d> in_world;
    std::vector<Eigen::Vector2d> bearings;
    std::vector<WorldPoint> points;
    for (const Sighting& s : table_.sightings) {
      const auto& point = state.points[static_cast<std::size_t>(s.item)];
      if (static_cast<std::size_t>(s.camera) != camera || !point) continue;
      in_world.push_back(*point);
      bearings.push_back(s.bearing);
      points.push_back({*point, s.pixel});
    }
    const CameraModel& model = cameras_[camera].model;
    const auto found = resectByPoints(in_world, bearings, tolerance_px_ / model.fx());
    if (!found || found->inliers < kFewestForACamera ||
        found->inliers < kFewestInlierShare * static_cast<double>(points.size()))
      return false;
    ResectionOptions options;
    options.robust_scale_px = tolerance_px_;
    const Resection refined = resectCamera(model, points, found->camera_from_world, options);
    const bool usable =
        refined.status == ResectionStatus::kConverged || refined.status == ResectionStatus::kIterationLimit;
    state.camera_from_world[camera] = usable ? refined.camera_from_world : found->camera_from_world;
    return true;
  }

  std::span<const RigCamera> cameras_;
  SightingTable& table_;
  double tolerance_px_;
  std::vector<std::size_t> starts_;
};

}  // namespace

RigState chainPoints(std::span<const RigCamera> cameras, SightingTable& table, double tolerance_px,
                     const ProgressCallback& progress) {
  Chain chain(cameras, table, tolerance_px);
  const std::vector<Pair> pairs = chain.pairs(progress);
  RigState best;
  best.camera_from_world.resize(cameras.size());
  best.points.resize(static_cast<std::size_t>(table.items));
  best.world_from_body.resize(best.points.size());
  best.fixed.assign(cameras.size(), false);
  int most = 0;
  for (std::size_t i = 0; i < std::min(pairs.size(), kFirstPairs); ++i) {
    RigState state = chain.grow(pairs[i]);
    const int explained = chain.explained();
    if (explained > most) {
      most = explained;
      best = std::move(state);
    }
    if (progress) progress(0.3 + 0.5 * static_cast<double>(i + 1) / kFirstPairs);
    if (most > kWellExplained * static_cast<double>(table.sightings.size())) break;
  }
  placePoints(best, cameras, table, tolerance_px);
  return best;
}

}  // namespace helical
