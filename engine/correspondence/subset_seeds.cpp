#include "engine/correspondence/subset_seeds.h"

#include <algorithm>
#include <array>
#include <optional>

#include "engine/base/check.h"
#include "engine/base/error.h"

namespace helical {
namespace {

constexpr int kFewestNamed = 4;

/// Nothing where those left are on a line: nothing could be named.
std::optional<MarkerLayout> layoutWithout(int omitted, const MarkerLayout& markers) {
  std::array<Eigen::Vector3d, kMaxMarkers> rest;
  std::size_t count = 0;
  for (int m = 0; m < markers.count(); ++m)
    if (m != omitted) rest[count++] = markers.inBody(markerId(m));
  try {
    return MarkerLayout({rest.data(), count}, markers.radius());
  } catch (const Error&) {
    return std::nullopt;
  }
}

}  // namespace

SubsetSeeds::SubsetSeeds(const CameraModel& camera, const MarkerLayout& markers)
    : balls_(markers.count()), whole_(camera, markers) {
  if (balls_ <= kFewestNamed) return;
  for (int omitted = 0; omitted < balls_; ++omitted) {
    const auto rest = layoutWithout(omitted, markers);
    if (!rest) continue;
    without_.emplace_back(camera, *rest);
    omitted_.push_back(static_cast<std::uint8_t>(omitted));
  }
}

void SubsetSeeds::correct(const MarkerLayout& markers) {
  whole_.correct(markers);
  for (std::size_t i = 0; i < without_.size(); ++i)
    if (const auto rest = layoutWithout(omitted_[i], markers)) without_[i].correct(*rest);
}

bool SubsetSeeds::accepts(int centroids) const {
  if (balls_ < kFewestNamed || centroids > std::min(balls_ + 1, kMaxMarkers)) return false;
  return centroids >= balls_ || (centroids == balls_ - 1 && !without_.empty());
}

void SubsetSeeds::start(std::span<const Eigen::Vector2d> pixels, ViewSide side) {
  HELICAL_CHECK(accepts(static_cast<int>(pixels.size())));
  std::copy(pixels.begin(), pixels.end(), pixels_.begin());
  count_ = pixels.size();
  side_ = side;
  const auto balls = static_cast<std::size_t>(balls_);
  left_ = count_ == balls ? Left::kNothing : count_ < balls ? Left::kMarker : Left::kCentroid;
  end_ = left_ == Left::kNothing ? 1 : left_ == Left::kMarker ? without_.size() : count_;
  stage_ = 0;
  beginStage();
}

void SubsetSeeds::beginStage() {
  if (left_ != Left::kCentroid) {
    (left_ == Left::kMarker ? without_[stage_] : whole_).start({pixels_.data(), count_}, side_);
    return;
  }
  std::array<Eigen::Vector2d, kMaxMarkers> rest;
  const auto from = pixels_.begin(), end = pixels_.begin() + static_cast<std::ptrdiff_t>(count_);
  const auto left_out = from + static_cast<std::ptrdiff_t>(stage_);
  std::copy(left_out + 1, end, std::copy(from, left_out, rest.begin()));
  whole_.start({rest.data(), count_ - 1}, side_);
}

std::optional<SeedLabelling> SubsetSeeds::next(double largest_rms_px) {
  if (done()) return std::nullopt;
  AffineSeeds& seeds = left_ == Left::kMarker ? without_[stage_] : whole_;
  std::optional<SeedLabelling> found = seeds.next(largest_rms_px);
  if (found) found = completed(*found);
  if (seeds.done() && ++stage_ < end_) beginStage();
  return found;
}

/// In the numbers of the whole layout and of all centroids.
SeedLabelling SubsetSeeds::completed(const SeedLabelling& seed) const {
  SeedLabelling whole = seed;
  if (left_ == Left::kMarker) {
    for (std::size_t k = 0; k < count_; ++k)
      if (whole.labelling.marker[k] >= omitted_[stage_]) ++whole.labelling.marker[k];
  } else if (left_ == Left::kCentroid) {
    auto& names = whole.labelling.marker;
    whole.labelling.count = static_cast<int>(count_);
    for (std::size_t k = count_ - 1; k > stage_; --k) names[k] = names[k - 1];
    names[stage_] = kNoMarker;
  }
  return whole;
}

}  // namespace helical
