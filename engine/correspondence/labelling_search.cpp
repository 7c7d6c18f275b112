#include "engine/correspondence/labelling_search.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "engine/base/check.h"
#include "engine/base/error.h"
#include "engine/geometry/planar_pnp.h"
#include "engine/geometry/rotation.h"

namespace helical {
namespace {

double alikePx2(const LabellingSearchOptions& options) {
  return options.alike_chi2 * options.resection.sigma_px * options.resection.sigma_px;
}

/// Layers of the first frame that has the layout's; of the first frame if none has.
ConvexLayers imageLayers(const ConvexLayers& layout, std::span<const LabellingFrame> frames) {
  const auto n = static_cast<std::size_t>(layout.points);
  for (const auto& frame : frames) {
    const ConvexLayers layers = peelConvexLayers({frame.pixels.data(), n});
    if (sameShape(layers, layout)) return layers;
  }
  return peelConvexLayers({frames.front().pixels.data(), n});
}

bool cameToRest(const ScoredLabelling& scored) {
  return scored.resection.status == ResectionStatus::kConverged ||
         scored.resection.status == ResectionStatus::kIterationLimit;
}

void forEachPermutation(int markers, auto&& use) {
  Labelling labelling;
  labelling.count = markers;
  const auto begin = labelling.marker.begin(), end = begin + markers;
  std::iota(begin, end, std::uint8_t{0});
  do use(labelling);
  while (std::next_permutation(begin, end));
}

double valueOf(const ScoredLabelling& scored, LabellingCriterion criterion) {
  switch (criterion) {
    case LabellingCriterion::kLiteral:
      return scored.difference_literal;
    case LabellingCriterion::kReprojection:
      return scored.resection.cost_px2;
    case LabellingCriterion::kNearestPlausible:
    case LabellingCriterion::kGeodesic:
      break;
  }
  return scored.difference_geodesic;
}

}  // namespace

void validate(const LabellingSearchOptions& options) {
  validate(options.resection);
  if (!(options.metres_per_radian >= 0.0) || !std::isfinite(options.metres_per_radian))
    throw Error(ErrorKind::kInput, "metres_per_radian is negative or no number", {}, "give 0 or more");
  if (!(options.alike_chi2 >= 0.0))
    throw Error(ErrorKind::kInput, "alike_chi2 is negative or no number", {}, "give 0 or more");
}

ConvexLayers layersOf(const MarkerLayout& markers) {
  std::array<Eigen::Vector2d, kMaxMarkers> in_plane;
  const auto n = static_cast<std::size_t>(markers.count());
  for (std::size_t m = 0; m < n; ++m) in_plane[m] = markers.all()[m].head<2>();
  return peelConvexLayers({in_plane.data(), n});
}

const ScoredLabelling* LabellingSearch::best(LabellingCriterion criterion) const {
  double least_cost = INFINITY;
  for (const auto& scored : labellings_)
    if (cameToRest(scored)) least_cost = std::min(least_cost, scored.resection.cost_px2);
  const ScoredLabelling* chosen = nullptr;
  for (const auto& scored : labellings_) {
    if (!cameToRest(scored)) continue;
    if (criterion == LabellingCriterion::kNearestPlausible &&
        scored.resection.cost_px2 > least_cost + alike_px2_)
      continue;
    if (!chosen || valueOf(scored, criterion) < valueOf(*chosen, criterion)) chosen = &scored;
  }
  return chosen;
}

TriedLabellings LabellingSearch::nearest(LabellingCriterion criterion, std::span<const Eigen::Vector2d> pixels) const {
  const auto entry = [&](const ScoredLabelling& scored) {
    const Labelling& labelling = scored.labelling;
    return fromLeftToRight({labelling.marker.data(), static_cast<std::size_t>(labelling.count)}, pixels,
                           scored.difference_geodesic);
  };
  TriedLabellings result;
  const ScoredLabelling* chosen = best(criterion);
  if (chosen == nullptr) return result;
  result.add(entry(*chosen));
  for (const auto& scored : labellings_)
    if (&scored != chosen && cameToRest(scored)) result.add(entry(scored));
  return result;
}

LabellingScorer::LabellingScorer(const CameraModel& camera, const MarkerLayout& markers,
                                 const LabellingSearchOptions& options)
    : camera_(camera), markers_(markers), options_(options) {
  points_.reserve(static_cast<std::size_t>(markers.count()));
  solutions_.reserve(3);
}

void LabellingScorer::start(std::span<const LabellingFrame> frames, const RigidTransform& prior) {
  frames_ = frames;
  prior_ = prior;
}

ScoredLabelling LabellingScorer::score(const Labelling& labelling) {
  placePoints(labelling);
  solutions_.clear();
  addSolution(prior_);
  if (options_.planar_starts && markers_.count() >= 4) addPlanarStarts(labelling);
  return nearestOfTheBest(labelling);
}

void LabellingScorer::placePoints(const Labelling& labelling) {
  points_.clear();
  for (const auto& frame : frames_)
    for (std::size_t k = 0; k < static_cast<std::size_t>(labelling.count); ++k)
      points_.push_back(
          {frame.world_from_body * markers_.inBody(MarkerId{labelling.marker[k]}), frame.pixels[k]});
}

void LabellingScorer::addPlanarStarts(const Labelling& labelling) {
  const auto n = static_cast<std::size_t>(labelling.count);
  std::array<Eigen::Vector3d, kMaxMarkers> in_body;
  for (std::size_t k = 0; k < n; ++k) in_body[k] = markers_.inBody(MarkerId{labelling.marker[k]});
  const LabellingFrame& frame = frames_.front();
  const PlanarPoses planar = solvePlanarPnp(camera_, {in_body.data(), n}, {frame.pixels.data(), n});
  for (std::size_t i = 0; i < static_cast<std::size_t>(planar.count); ++i)
    addSolution(planar.poses[i].camera_from_body * frame.world_from_body.inverse());
}

void LabellingScorer::addSolution(const RigidTransform& start) {
  const Resection resection = resectCamera(camera_, points_, start, options_.resection);
  if (resection.status == ResectionStatus::kDiverged || resection.status == ResectionStatus::kDegenerate)
    return;
  solutions_.push_back({{}, resection, geodesic(resection), literal(resection)});
}

/// A plane seen once has two poses that explain it almost alike: of those the one nearer to the guess.
ScoredLabelling LabellingScorer::nearestOfTheBest(const Labelling& labelling) const {
  ScoredLabelling chosen;
  if (!solutions_.empty()) {
    double least = solutions_.front().resection.cost_px2;
    for (const auto& solution : solutions_) least = std::min(least, solution.resection.cost_px2);
    const double alike = least + alikePx2(options_);
    chosen.difference_geodesic = INFINITY;
    for (const auto& solution : solutions_)
      if (solution.resection.cost_px2 <= alike && solution.difference_geodesic < chosen.difference_geodesic)
        chosen = solution;
  }
  chosen.labelling = labelling;
  return chosen;
}

double LabellingScorer::geodesic(const Resection& resection) const {
  const RigidTransform& found = resection.camera_from_world;
  const double angle = logSO3(found.rotation * prior_.rotation.conjugate()).norm();
  return (found.inverseTranslation() - prior_.inverseTranslation()).norm() +
         options_.metres_per_radian * angle;
}

double LabellingScorer::literal(const Resection& resection) const {
  const RigidTransform& found = resection.camera_from_world;
  return (found.translation - prior_.translation).norm() +
         (logSO3(found.rotation) - logSO3(prior_.rotation)).norm();
}

LabellingWalk::LabellingWalk(const CameraModel& camera, const MarkerLayout& markers,
                             const LabellingSearchOptions& options)
    : options_(options),
      layout_(layersOf(markers)),
      scorer_(camera, markers, options),
      found_(alikePx2(options)) {
  const double sides = options.side == ViewSide::kEither ? 2.0 : 1.0;
  found_.reserve(static_cast<std::size_t>(std::ceil(sides * theoremOneBound(markers.count()))));
}

void LabellingWalk::correct(const CameraModel& camera, const MarkerLayout& markers) {
  stop();
  layout_ = layersOf(markers);
  scorer_.correct(camera, markers);
}

void LabellingWalk::start(const LabellingFrame& frame, const RigidTransform& prior) {
  frame_ = frame;
  scorer_.start({&frame_, 1}, prior);
  found_.clear();
  labellings_.emplace(layout_, imageLayers(layout_, {&frame_, 1}), options_.side);
}

void LabellingWalk::advance(int count) {
  Labelling labelling;
  for (; running() && count > 0; --count) {
    if (labellings_->next(labelling))
      found_.add(scorer_.score(labelling));
    else
      stop();
  }
}

LabellingSearch searchLabellings(const CameraModel& camera, const MarkerLayout& markers,
                                 std::span<const LabellingFrame> frames, const RigidTransform& prior,
                                 const LabellingSearchOptions& options) {
  HELICAL_CHECK(!frames.empty());
  LabellingScorer scorer(camera, markers, options);
  scorer.start(frames, prior);
  LabellingSearch search(alikePx2(options));
  if (options.scope == LabellingScope::kEveryPermutation) {
    forEachPermutation(markers.count(),
                       [&](const Labelling& labelling) { search.add(scorer.score(labelling)); });
    return search;
  }
  const ConvexLayers layout = layersOf(markers);
  NestedLabellings labellings(layout, imageLayers(layout, frames), options.side);
  Labelling labelling;
  while (labellings.next(labelling)) search.add(scorer.score(labelling));
  return search;
}

}  // namespace helical
