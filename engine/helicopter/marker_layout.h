#pragma once

#include <Eigen/Core>
#include <array>
#include <span>

#include "engine/base/ids.h"

namespace helical {

/// The coloured balls under the helicopter: centres in the body frame [m] and one radius for all [m].
class MarkerLayout {
 public:
  MarkerLayout() = default;
  /// Throws Error(kInput) for fewer than 3 or more than kMaxMarkers markers, collinear ones or a radius <= 0.
  MarkerLayout(std::span<const Eigen::Vector3d> markers_in_body, double radius);

  /// Four balls, almost a square, each on its own rod: the layout of the paper's figure 5, made asymmetric by
  /// some centimetres so that the heading can be told from the markers.
  static MarkerLayout paper();

  int count() const { return count_; }
  const Eigen::Vector3d& inBody(MarkerId marker) const {
    return markers_[static_cast<std::size_t>(marker.index())];
  }
  std::span<const Eigen::Vector3d> all() const { return {markers_.data(), static_cast<std::size_t>(count_)}; }
  double radius() const { return radius_; }

 private:
  std::array<Eigen::Vector3d, kMaxMarkers> markers_{};
  int count_ = 0;
  double radius_ = 0.0;
};

}  // namespace helical
