#pragma once

#include <optional>
#include <span>

namespace helical {

struct OutlinePoint {
  double x;
  double y;
};

struct OutlineCircle {
  OutlinePoint centre;
  double radius;
};

/// Nothing if they lie on a line, or nearly.
std::optional<OutlineCircle> circleThrough(const OutlinePoint& a, const OutlinePoint& b,
                                           const OutlinePoint& c);

/// How many points lie on a circle as a ball's outline does, and the circle through these by least squares.
int pointsOn(const OutlineCircle& circle, std::span<const OutlinePoint> outline);
OutlineCircle throughPointsOn(const OutlineCircle& circle, std::span<const OutlinePoint> outline);

/// The circle that most points of an outline lie on, through these of them: where something hides a part of a
/// ball, the rest of its outline is still round. The points are in order along the outline; `radius` is that
/// of a disc of the outline's area, and of circles much smaller or larger there are none. No allocation.
std::optional<OutlineCircle> bestCircle(std::span<const OutlinePoint> outline, double radius);

}  // namespace helical
