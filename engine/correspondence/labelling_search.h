#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <span>
#include <vector>

#include "engine/correspondence/nested_polygons.h"
#include "engine/correspondence/tried_labellings.h"
#include "engine/geometry/camera_resection.h"
#include "engine/helicopter/marker_layout.h"

namespace helical {

/// The un-calibrated camera's centroids while the helicopter stood in a known pose. A centroid keeps its
/// place in `pixels` from frame to frame.
struct LabellingFrame {
  RigidTransform world_from_body;
  std::array<Eigen::Vector2d, kMaxMarkers> pixels{};  ///< as many as the layout has markers
};

/// By what the one labelling is chosen.
enum class LabellingCriterion {
  /// Of the labellings that explain the pixels as well as the best (`alike_chi2`) the least kGeodesic.
  kNearestPlausible,
  kGeodesic,      ///< centre distance plus `metres_per_radian` times the angle between the orientations
  kLiteral,       ///< the paper's eq. 9: norms of the differences of t [m] and of the rotation vector [rad]
  kReprojection,  ///< reprojection error
};

enum class LabellingScope {
  kNestedPolygons,    ///< the paper's method
  kEveryPermutation,  ///< its full search: N! labellings
};

struct LabellingSearchOptions {
  LabellingScope scope = LabellingScope::kNestedPolygons;
  ViewSide side = ViewSide::kAbove;
  double metres_per_radian = 1.5;  ///< of the geodesic distance: about what a first guess errs in either
  bool planar_starts = true;       ///< from 4 markers on: also start from the two planar poses
  /// A pose explains the pixels as well as another when its squared residuals sum up to less than this many
  /// sigma^2 more.
  double alike_chi2 = 40.0;
  ResectionOptions resection;
};

void validate(const LabellingSearchOptions& options);  ///< throws Error(kInput)

/// One labelling, the camera's best pose under it, and how far that is from the first guess.
struct ScoredLabelling {
  Labelling labelling;
  Resection resection;
  double difference_geodesic = 0.0;  ///< De [m]
  double difference_literal = 0.0;   ///< De [m + rad]
};

/// Outcome of a search. Without any labelling the layers of image and layout differ in shape.
class LabellingSearch {
 public:
  /// `alike_px2`: by how much the sum of squared residuals may exceed the best one's.
  explicit LabellingSearch(double alike_px2 = 0.0) : alike_px2_(alike_px2) {}

  void reserve(std::size_t count) { labellings_.reserve(count); }
  void clear() { labellings_.clear(); }
  void add(const ScoredLabelling& scored) { labellings_.push_back(scored); }

  const std::vector<ScoredLabelling>& labellings() const { return labellings_; }

  /// Of the labellings whose resection came to rest the one that `criterion` prefers; null if there is none.
  const ScoredLabelling* best(LabellingCriterion criterion) const;

  /// `best` and those that come nearest to it by De; `pixels` are the frame's. Allocates nothing.
  TriedLabellings nearest(LabellingCriterion criterion, std::span<const Eigen::Vector2d> pixels) const;

 private:
  std::vector<ScoredLabelling> labellings_;
  double alike_px2_;
};

/// Scores one labelling after the other. Allocates at construction only. One thread.
class LabellingScorer {
 public:
  LabellingScorer(const CameraModel& camera, const MarkerLayout& markers,
                  const LabellingSearchOptions& options);

  void correct(const CameraModel& camera, const MarkerLayout& markers) {
    camera_ = camera;
    markers_ = markers;
  }
  /// `frames` stay valid while labellings are scored.
  void start(std::span<const LabellingFrame> frames, const RigidTransform& prior);
  ScoredLabelling score(const Labelling& labelling);

 private:
  void placePoints(const Labelling& labelling);
  void addPlanarStarts(const Labelling& labelling);
  void addSolution(const RigidTransform& start);
  ScoredLabelling nearestOfTheBest(const Labelling& labelling) const;
  double geodesic(const Resection& resection) const;
  double literal(const Resection& resection) const;

  CameraModel camera_;
  MarkerLayout markers_;
  LabellingSearchOptions options_;
  std::span<const LabellingFrame> frames_;
  RigidTransform prior_;
  std::vector<WorldPoint> points_;
  std::vector<ScoredLabelling> solutions_;
};

/// The search over nested polygons of one frame a few labellings at a time, for a camera whose images must
/// not wait for it. Allocates at construction only. One thread.
class LabellingWalk {
 public:
  LabellingWalk(const CameraModel& camera, const MarkerLayout& markers,
                const LabellingSearchOptions& options = {});

  /// Camera and balls are these instead, as many as before. A walk that goes on is broken off.
  void correct(const CameraModel& camera, const MarkerLayout& markers);

  void start(const LabellingFrame& frame, const RigidTransform& prior);
  void stop() { labellings_.reset(); }
  bool running() const { return labellings_.has_value(); }

  /// Scores at most `count` labellings.
  void advance(int count);

  /// Of a walk that is done.
  const LabellingSearch& found() const { return found_; }
  /// `LabellingSearch::nearest` of them.
  TriedLabellings nearest(LabellingCriterion criterion) const {
    return found_.nearest(criterion, {frame_.pixels.data(), static_cast<std::size_t>(layout_.points)});
  }

 private:
  LabellingSearchOptions options_;
  ConvexLayers layout_;
  LabellingScorer scorer_;
  LabellingFrame frame_;
  std::optional<NestedLabellings> labellings_;
  LabellingSearch found_;
};

/// The paper's III.B, steps 5 to 8: for every labelling the camera's pose by resection over all frames, and
/// its distance from `prior`, a first guess of camera_from_world. Polygons are those of the first frame whose
/// layers have the layout's shape in the body's x-y plane. At least one frame.
LabellingSearch searchLabellings(const CameraModel& camera, const MarkerLayout& markers,
                                 std::span<const LabellingFrame> frames, const RigidTransform& prior,
                                 const LabellingSearchOptions& options = {});

/// The layout's convex layers in the body's x-y plane.
ConvexLayers layersOf(const MarkerLayout& markers);

}  // namespace helical
