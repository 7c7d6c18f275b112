#include "engine/calibration/rig/wide_delays.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "engine/calibration/rig/instants.h"
#include "engine/calibration/rig/pair_geometry.h"
#include "engine/calibration/rig/quantile.h"

namespace helical {
namespace {

constexpr double kReachS = 1.0;
constexpr double kCoarseStepS = 1.0 / 29.0, kFineStepS = 1.0 / 120.0;
constexpr std::size_t kMostRows = 150'000;  // minutes of them tell as much as hours
constexpr std::size_t kMostPoints = 160, kFewestPoints = 40;
constexpr std::size_t kMostReferences = 2;
constexpr int kSamples = 100;
// Where stamps are right most points fit, elsewhere only those that happen to: by their own, and by their
// share of it.
constexpr double kLeastShare = 0.45, kOverUsual = 1.6;

using TrackPoint = std::tuple<std::int32_t, double, double, double, std::int64_t>;
using Tracks = std::map<TrackPoint, const InstantRow*>;

TrackPoint keyOf(const InstantRow& row, std::int64_t instant) {
  return {row.row.marker, row.in_body.x(), row.in_body.y(), row.in_body.z(), instant};
}

/// The middle of a long recording.
PointRows middleOf(const PointRows& rows) {
  if (rows.rows.size() <= kMostRows) return rows;
  const auto first = static_cast<std::ptrdiff_t>((rows.rows.size() - kMostRows) / 2);
  const auto middle = [first](const auto& all) {
    return std::vector(all.begin() + first, all.begin() + first + static_cast<std::ptrdiff_t>(kMostRows));
  };
  PointRows part;
  part.markers = rows.markers;
  part.rows = middle(rows.rows);
  if (!rows.in_body.empty()) part.in_body = middle(rows.in_body);
  return part;
}

class DelaySearch {
 public:
  DelaySearch(const PointRows& rows, std::span<const RigCamera> cameras, double period_s, double tolerance_px)
      : cameras_(cameras), period_s_(period_s), tolerance_px_(tolerance_px), tracks_(cameras.size()) {
    instants_ = interpolateInTime(middleOf(rows), period_s);
    for (const InstantRow& row : instants_)
      tracks_[static_cast<std::size_t>(row.row.camera)].emplace(keyOf(row, row.instant), &row);
  }

  std::size_t seen(std::size_t camera) const { return tracks_[camera].size(); }

  struct Peak {
    double late_s = 0.0, share = 0.0;
  };

  /// Of `camera` against another one: nothing unless it stands out. A light's way is like itself for a
  /// twentieth of a second on both sides, so that coarse steps do not miss the peak.
  Peak against(std::size_t reference, std::size_t camera) const {
    const double step = std::max(0.5 * period_s_, kFineStepS);
    const int every = std::max(1, static_cast<int>(kCoarseStepS / step));
    const int steps = static_cast<int>(kReachS / (step * every)) * every;
    std::vector<double> shares;
    Peak best;
    int at = 0;
    const auto look = [&](int k) {
      const double share = fitting(reference, camera, k * step);
      if (share > best.share) best = {k * step, share}, at = k;
      return share;
    };
    for (int k = -steps; k <= steps; k += every) shares.push_back(look(k));
    for (int k = at - every + 1, end = at + every; k < end; ++k) look(k);
    if (best.share < kLeastShare || best.share < kOverUsual * quantileOf(shares, 0.5)) return {};
    return best;
  }

 private:
  /// Share of points that lie on each other's epipolar lines if `camera` saw that much later than it says.
  double fitting(std::size_t reference, std::size_t camera, double late_s) const {
    const double periods = std::floor(late_s / period_s_);
    const double rest_s = late_s - periods * period_s_;
    const auto whole = static_cast<std::int64_t>(periods);
    const CameraModel &model = cameras_[camera].model, &other = cameras_[reference].model;
    std::vector<Eigen::Vector2d> in_reference, in_camera;
    const Tracks& track = tracks_[camera];
    const std::size_t by = track.size() / kMostPoints + 1;
    std::size_t i = 0;
    for (const auto& [key, row] : track) {
      if (i++ % by != 0) continue;
      const auto found = tracks_[reference].find(keyOf(*row, row->instant + whole));
      if (found == tracks_[reference].end()) continue;
      const InstantRow& seen = *found->second;
      in_reference.push_back(other.bearing(seen.row.pixel + rest_s * seen.motion.velocity));
      in_camera.push_back(model.bearing(row->row.pixel));
    }
    if (in_camera.size() < kFewestPoints) return 0.0;
    const auto pair =
        relatePair(in_reference, in_camera, 0.5 * tolerance_px_ / std::min(model.fx(), other.fx()), kSamples);
    return pair ? static_cast<double>(pair->inliers) / static_cast<double>(in_camera.size()) : 0.0;
  }

  std::span<const RigCamera> cameras_;
  double period_s_, tolerance_px_;
  std::vector<InstantRow> instants_;
  std::vector<Tracks> tracks_;
};

}  // namespace

std::vector<double> wideDelays(const PointRows& rows, std::span<const RigCamera> cameras,
                               const std::vector<bool>& misfit, double period_s, double tolerance_px) {
  std::vector<double> late_s(cameras.size(), 0.0);
  if (!(period_s > 0.0)) return late_s;
  const DelaySearch search(rows, cameras, period_s, tolerance_px);
  std::vector<std::size_t> references(cameras.size());
  for (std::size_t c = 0; c < references.size(); ++c) references[c] = c;
  std::stable_sort(references.begin(), references.end(), [&](std::size_t a, std::size_t b) {
    return std::pair(misfit[b], search.seen(a)) > std::pair(misfit[a], search.seen(b));
  });
  const auto fit = static_cast<std::size_t>(std::count(misfit.begin(), misfit.end(), false));
  references.resize(std::clamp<std::size_t>(fit, 1, kMostReferences));
  for (std::size_t c = 0; c < cameras.size(); ++c) {
    if (!misfit[c] || c == references.front()) continue;
    DelaySearch::Peak best;
    for (const std::size_t reference : references)
      if (best.share == 0.0) best = search.against(reference, c);
    if (std::abs(best.late_s) > 0.75 * period_s) late_s[c] = best.late_s;
  }
  return late_s;
}

}  // namespace helical
