#include "engine/correspondence/affine_seed.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "engine/base/check.h"

namespace helical {
namespace {

constexpr int kRefinements = 4;
constexpr double kLostRmsPx = 60.0;  // names from such a map say nothing

/// Shift and scale that bring points to the origin's neighbourhood.
struct Normaliser {
  explicit Normaliser(std::span<const Eigen::Vector2d> points) {
    for (const auto& point : points) centre += point / static_cast<double>(points.size());
    for (const auto& point : points) scale = std::max(scale, (point - centre).norm());
  }
  Eigen::Vector2d operator()(const Eigen::Vector2d& point) const { return (point - centre) / scale; }

  Eigen::Vector2d centre = Eigen::Vector2d::Zero();
  double scale = 0.0;
};

std::size_t cornerOf(const HullOrder& hull, int i) {
  return hull.index[static_cast<std::size_t>(((i % hull.count) + hull.count) % hull.count)];
}

}  // namespace

AffineSeeds::AffineSeeds(const CameraModel& camera, const MarkerLayout& markers)
    : camera_(&camera), n_(static_cast<std::size_t>(markers.count())) {
  correct(markers);
}

void AffineSeeds::correct(const MarkerLayout& markers) {
  HELICAL_CHECK(static_cast<std::size_t>(markers.count()) == n_);
  markers_ = markers;
  model_hull_ = {};
  std::array<Eigen::Vector2d, kMaxMarkers> in_plane;
  for (std::size_t m = 0; m < n_; ++m) in_plane[m] = markers.all()[m].head<2>();
  const Normaliser model({in_plane.data(), n_});
  if (!(model.scale > 0.0)) return;
  for (std::size_t i = 0; i < n_; ++i) model_[i] = model(in_plane[i]);
  model_hull_ = convexHull({model_.data(), n_});
}

void AffineSeeds::start(std::span<const Eigen::Vector2d> pixels, ViewSide side) {
  HELICAL_CHECK(n_ >= 4 && pixels.size() == n_);
  std::copy(pixels.begin(), pixels.end(), pixels_.begin());
  const Normaliser image(pixels);
  pixel_scale_ = image.scale;
  found_count_ = 0;
  side_ = 2;
  if (!(image.scale > 0.0)) return;
  for (std::size_t i = 0; i < n_; ++i) image_[i] = image(pixels[i]);
  image_hull_ = convexHull({image_.data(), n_});
  if (model_hull_.count < 3 || image_hull_.count < 3) return;
  wanted_ = {side != ViewSide::kBelow, side != ViewSide::kAbove};
  side_ = wanted_[0] ? 0 : 1;
  corner_ = shift_ = 0;
}

void AffineSeeds::advance() {
  if (++shift_ < image_hull_.count) return;
  shift_ = 0;
  // Where the hulls agree in size, any one corner of the layout meets every corner of the image once.
  const int corners = model_hull_.count == image_hull_.count ? 1 : model_hull_.count;
  if (++corner_ < corners) return;
  corner_ = 0;
  side_ = side_ == 0 && wanted_[1] ? 1 : 2;
}

std::optional<SeedLabelling> AffineSeeds::next(double largest_rms_px) {
  if (done()) return std::nullopt;
  const auto map = affineMap(side_ == 0);
  advance();
  if (!map) return std::nullopt;
  const auto labelling = refinedNames(*map);
  if (!labelling) return std::nullopt;
  const auto found_end = found_.begin() + static_cast<std::ptrdiff_t>(found_count_);
  if (std::find(found_.begin(), found_end, *labelling) != found_end) return std::nullopt;
  found_[found_count_++] = *labelling;
  std::array<Eigen::Vector3d, kMaxMarkers> in_body;
  for (std::size_t k = 0; k < n_; ++k) in_body[k] = markers_.inBody(MarkerId{labelling->marker[k]});
  const PlanarPoses poses = solvePlanarPnp(*camera_, {in_body.data(), n_}, {pixels_.data(), n_});
  if (poses.count == 0 || !(poses.poses[0].rms_px < largest_rms_px)) return std::nullopt;
  return SeedLabelling{*labelling, poses};
}

/// Least squares over all corners where the hulls agree in size, else through three neighbours.
std::optional<AffineSeeds::PlaneMap> AffineSeeds::affineMap(bool reversed) const {
  const int used = model_hull_.count == image_hull_.count ? model_hull_.count : 3;
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Matrix<double, 3, 2> right = Eigen::Matrix<double, 3, 2>::Zero();
  for (int i = 0; i < used; ++i) {
    const Eigen::Vector3d x = model_[cornerOf(model_hull_, corner_ + i)].homogeneous();
    normal += x * x.transpose();
    right += x * image_[cornerOf(image_hull_, reversed ? shift_ - i : shift_ + i)].transpose();
  }
  const Eigen::FullPivLU<Eigen::Matrix3d> solver(normal);
  if (!solver.isInvertible()) return std::nullopt;
  PlaneMap map = PlaneMap::Identity();
  map.topRows<2>() = solver.solve(right).transpose();
  return map;
}

/// One to one, closest pairs first. `rms_px` is of the distances, per axis.
Labelling AffineSeeds::nameByMap(const PlaneMap& map, double& rms_px) const {
  struct Pair {
    double distance2;
    std::uint8_t marker, centroid;
  };
  std::array<Pair, kMaxMarkers * kMaxMarkers> pairs;
  for (std::size_t m = 0; m < n_; ++m) {
    const Eigen::Vector2d place = (map * model_[m].homogeneous()).hnormalized();
    for (std::size_t k = 0; k < n_; ++k)
      pairs[m * n_ + k] = {(place - image_[k]).squaredNorm(), static_cast<std::uint8_t>(m),
                           static_cast<std::uint8_t>(k)};
  }
  std::sort(pairs.begin(), pairs.begin() + static_cast<std::ptrdiff_t>(n_ * n_),
            [](const Pair& a, const Pair& b) { return a.distance2 < b.distance2; });
  Labelling labelling;
  labelling.count = static_cast<int>(n_);
  std::array<bool, kMaxMarkers> marker_used{}, centroid_used{};
  double sum = 0.0;
  for (std::size_t i = 0; i < n_ * n_; ++i) {
    const Pair& pair = pairs[i];
    if (marker_used[pair.marker] || centroid_used[pair.centroid]) continue;
    marker_used[pair.marker] = centroid_used[pair.centroid] = true;
    labelling.marker[pair.centroid] = pair.marker;
    sum += pair.distance2;
  }
  rms_px = pixel_scale_ * std::sqrt(sum / (2.0 * static_cast<double>(n_)));
  return labelling;
}

/// Through all named centroids: the eigenvector of the smallest eigenvalue of A^T A.
AffineSeeds::PlaneMap AffineSeeds::homography(const Labelling& labelling) const {
  Eigen::Matrix<double, 9, 9> normal = Eigen::Matrix<double, 9, 9>::Zero();
  for (std::size_t k = 0; k < n_; ++k) {
    const Eigen::Vector2d& x = model_[labelling.marker[k]];
    const Eigen::Vector2d& u = image_[k];
    Eigen::Matrix<double, 2, 9> rows = Eigen::Matrix<double, 2, 9>::Zero();
    rows.block<1, 3>(0, 0) = x.homogeneous().transpose();
    rows.block<1, 3>(1, 3) = x.homogeneous().transpose();
    rows.rightCols<3>() = -u * x.homogeneous().transpose();
    normal += rows.transpose() * rows;
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 9, 9>> solver(normal);
  return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(solver.eigenvectors().data());
}

std::optional<Labelling> AffineSeeds::refinedNames(PlaneMap map) const {
  Labelling labelling;
  for (int i = 0; i < kRefinements; ++i) {
    double rms_px = 0.0;
    const Labelling named = nameByMap(map, rms_px);
    if (!(rms_px < kLostRmsPx)) return std::nullopt;
    if (named == labelling) break;
    labelling = named;
    map = homography(labelling);
  }
  return labelling;
}

std::vector<SeedLabelling> affineSeedLabellings(const CameraModel& camera, const MarkerLayout& markers,
                                                std::span<const Eigen::Vector2d> pixels, ViewSide side,
                                                double largest_rms_px) {
  HELICAL_CHECK(markers.count() >= 4 && pixels.size() == static_cast<std::size_t>(markers.count()));
  AffineSeeds search(camera, markers);
  std::vector<SeedLabelling> found;
  for (search.start(pixels, side); !search.done();)
    if (const auto seed = search.next(largest_rms_px)) found.push_back(*seed);
  std::sort(found.begin(), found.end(), [](const SeedLabelling& a, const SeedLabelling& b) {
    return a.poses.poses[0].rms_px < b.poses.poses[0].rms_px;
  });
  return found;
}

}  // namespace helical
