#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <span>
#include <vector>

#include "engine/correspondence/convex_hull.h"
#include "engine/correspondence/nested_polygons.h"
#include "engine/geometry/planar_pnp.h"
#include "engine/helicopter/marker_layout.h"

namespace helical {

/// A labelling, and the camera's two poses towards the body under it, the better one first.
struct SeedLabelling {
  Labelling labelling;
  PlanarPoses poses;
};

/// Names centroids without any guess of the camera's pose: from afar a plane's image is almost affine, so
/// three neighbours on the hull of layout and image give an affine map for each cyclic shift; nearest
/// neighbours under it name all centroids, a homography through them refines the names, and the reprojection
/// error of the planar pose decides. Polynomial in the number of markers, and a point that noise moved over
/// an edge of the hull does no harm.
///
/// One map after another, so that a flight can spread them over frames: `next` costs one homography and one
/// planar pose at most. Allocates nothing. The camera must outlive it.
class AffineSeeds {
 public:
  /// Nothing is sought before `start`.
  AffineSeeds(const CameraModel& camera, const MarkerLayout& markers);

  /// The balls are here instead, as many as before; what goes on goes on with these.
  void correct(const MarkerLayout& markers);

  /// `pixels` are as many as the markers, 4 or more, which lie close to a plane z = const of the body.
  void start(std::span<const Eigen::Vector2d> pixels, ViewSide side);

  bool done() const { return side_ == 2; }

  /// Tries the next map: a labelling that no earlier one gave and that fits within `largest_rms_px`, or
  /// nothing, which does not mean that there is no other.
  std::optional<SeedLabelling> next(double largest_rms_px);

 private:
  using PlaneMap = Eigen::Matrix3d;  ///< plane to plane, for coordinates brought to unit size

  void advance();
  std::optional<PlaneMap> affineMap(bool reversed) const;
  Labelling nameByMap(const PlaneMap& map, double& rms_px) const;
  PlaneMap homography(const Labelling& labelling) const;
  std::optional<Labelling> refinedNames(PlaneMap map) const;

  const CameraModel* camera_;
  MarkerLayout markers_;
  std::size_t n_;
  std::array<Eigen::Vector2d, kMaxMarkers> model_, pixels_, image_;
  double pixel_scale_ = 0.0;
  HullOrder model_hull_, image_hull_;
  std::array<bool, 2> wanted_{};  ///< the side with its order reversed, the other
  int side_ = 2, corner_ = 0, shift_ = 0;
  std::array<Labelling, 2 * kMaxMarkers * kMaxMarkers> found_;
  std::size_t found_count_ = 0;
};

/// All that AffineSeeds finds in one image, best first: layouts that look alike after a turn have several.
/// Not for the flight's per-frame path: it allocates.
std::vector<SeedLabelling> affineSeedLabellings(const CameraModel& camera, const MarkerLayout& markers,
                                                std::span<const Eigen::Vector2d> pixels,
                                                ViewSide side = ViewSide::kAbove,
                                                double largest_rms_px = 40.0);

}  // namespace helical
