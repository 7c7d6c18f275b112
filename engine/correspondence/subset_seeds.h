#pragma once

#include "engine/correspondence/affine_seed.h"

namespace helical {

/// A centroid of a labelling that is no marker.
inline constexpr std::uint8_t kNoMarker = 255;

/// AffineSeeds for images in which one ball is missing or one region is false: a ball behind the fuselage, a lamp of
/// the balls' colour. One after the other every ball, or every centroid, is left out. Many of these subsets fit a
/// wrong labelling by chance, the more the fewer balls there are, so that several frames have to decide. Interface
/// and costs of AffineSeeds; allocates at construction only. The camera must outlive it.
class SubsetSeeds {
 public:
  SubsetSeeds(const CameraModel& camera, const MarkerLayout& markers);

  /// The balls are here instead, as many as before.
  void correct(const MarkerLayout& markers);

  /// Whether so many centroids can be named: as many as the markers, one more or one less, four named ones at least.
  bool accepts(int centroids) const;

  /// `pixels`: as many as it accepts.
  void start(std::span<const Eigen::Vector2d> pixels, ViewSide side);
  void stop() { stage_ = end_ = 0; }

  bool done() const { return stage_ == end_; }
  /// As of AffineSeeds; a false centroid's marker is kNoMarker.
  std::optional<SeedLabelling> next(double largest_rms_px);

 private:
  enum class Left { kNothing, kMarker, kCentroid };

  void beginStage();
  SeedLabelling completed(const SeedLabelling& seed) const;

  int balls_;
  AffineSeeds whole_;
  std::vector<AffineSeeds> without_;  ///< each, where such a layout exists, without one marker
  std::vector<std::uint8_t> omitted_;
  std::array<Eigen::Vector2d, kMaxMarkers> pixels_;
  std::size_t count_ = 0;
  ViewSide side_ = ViewSide::kEither;
  Left left_ = Left::kNothing;
  std::size_t stage_ = 0, end_ = 0;
};

}  // namespace helical
