#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

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
/// Every distinct labelling that fits within `largest_rms_px`, best first: layouts that look alike after a
/// turn have several. `pixels` are as many as the markers, 4 or more, which lie close to a plane z = const of
/// the body. Not for the flight's per-frame path: it allocates.
std::vector<SeedLabelling> affineSeedLabellings(const CameraModel& camera, const MarkerLayout& markers,
                                                std::span<const Eigen::Vector2d> pixels,
                                                ViewSide side = ViewSide::kAbove,
                                                double largest_rms_px = 40.0);

}  // namespace helical
