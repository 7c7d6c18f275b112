#include "engine/calibration/rig/instants.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include "engine/calibration/rig/quantile.h"

namespace helical {
namespace {

constexpr double kSameStamp = 2e-6;  // s
constexpr long kTellingFrames = 20;  // of a camera: fewer say nothing of its rhythm
constexpr double kLongestGap = 2.5;  // periods
// A third of false centroids makes half of the steps false ones: the usual step is that of the slower of the
// others.
constexpr double kUsualQuantile = 0.25, kUsualSteps = 6.0;
constexpr double kSmallStepPx = 5.0;
constexpr double kRestPx =
    1.0;  // a step that is noise: where a target rests, the slower ones are none of its way

/// Of rows of one track. A body's points may go without names: their places in it tell them apart.
auto trackKey(const PointRow& row, const Eigen::Vector3d& in_body) {
  return std::tuple(row.camera, row.marker, in_body.x(), in_body.y(), in_body.z());
}

/// Which neighbours in a track belong together: neither far apart in time, nor by a jump far beyond the
/// track's usual step.
class Bridge {
 public:
  /// `pixel_of(i)`: of the track's i-th row.
  template <typename PixelOf>
  Bridge(std::size_t rows, double period_s, const PixelOf& pixel_of)
      : longest_gap_s_(kLongestGap * period_s) {
    std::vector<double> steps;
    for (std::size_t i = 1; i < rows; ++i)
      if (const double step = (pixel_of(i) - pixel_of(i - 1)).norm(); step > kRestPx) steps.push_back(step);
    largest_step_px_ = std::max(kSmallStepPx, kUsualSteps * quantileOf(steps, kUsualQuantile));
  }

  bool holds(const PointRow& a, const PointRow& b) const {
    const double gap = b.time_s - a.time_s;
    return gap > 0.0 && gap <= longest_gap_s_ && (b.pixel - a.pixel).norm() <= largest_step_px_;
  }

 private:
  double longest_gap_s_, largest_step_px_ = 0.0;
};

void interpolateTrack(const PointRows& rows, std::span<const std::size_t> track, double start_s,
                      double period_s, std::vector<InstantRow>& out) {
  const Bridge bridge(track.size(), period_s, [&](std::size_t i) { return rows.rows[track[i]].pixel; });
  for (std::size_t i = 1; i < track.size(); ++i) {
    const PointRow &a = rows.rows[track[i - 1]], &b = rows.rows[track[i]];
    if (!bridge.holds(a, b)) continue;
    const double gap = b.time_s - a.time_s;
    const auto first = static_cast<std::int64_t>(std::ceil((a.time_s - start_s) / period_s));
    for (std::int64_t k = first;; ++k) {
      const double time = start_s + static_cast<double>(k) * period_s;
      if (time >= b.time_s) break;
      const double share = (time - a.time_s) / gap;
      InstantRow row;
      row.row = a;
      row.row.time_s = time;
      row.row.pixel = a.pixel + share * (b.pixel - a.pixel);
      if (!rows.in_body.empty()) row.in_body = rows.in_body[track[i - 1]];
      row.instant = k;
      row.motion = {true, (b.pixel - a.pixel) / gap, Eigen::Vector2d::Zero()};
      out.push_back(row);
    }
  }
}

/// The parabola through a row and its neighbours on both sides, else the line to the one that there is.
PixelMotion motionAt(const PointRow* before, const PointRow& row, const PointRow* after) {
  const auto slope = [](const PointRow& a, const PointRow& b) -> Eigen::Vector2d {
    return (b.pixel - a.pixel) / (b.time_s - a.time_s);
  };
  if (before == nullptr && after == nullptr) return {};
  if (before == nullptr) return {true, slope(row, *after), Eigen::Vector2d::Zero()};
  if (after == nullptr) return {true, slope(*before, row), Eigen::Vector2d::Zero()};
  const Eigen::Vector2d in = slope(*before, row), out = slope(row, *after);
  const double gap_in = row.time_s - before->time_s, gap_out = after->time_s - row.time_s;
  return {true, (in * gap_out + out * gap_in) / (gap_in + gap_out), 2.0 * (out - in) / (gap_in + gap_out)};
}

}  // namespace

Rhythm rhythmOf(const PointRows& rows, int cameras) {
  // Rows are in order of time: stamps of a camera, and whether another camera has the same one.
  std::vector<double> last(static_cast<std::size_t>(cameras), -1e300);
  std::vector<double> gaps;
  std::vector<long> frames(last.size(), 0), shared(last.size(), 0);
  std::vector<bool> present(static_cast<std::size_t>(cameras));
  for (std::size_t i = 0; i < rows.rows.size();) {
    std::size_t j = i;
    std::fill(present.begin(), present.end(), false);
    int count = 0;
    for (; j < rows.rows.size() && rows.rows[j].time_s - rows.rows[i].time_s <= kSameStamp; ++j) {
      const auto camera = static_cast<std::size_t>(rows.rows[j].camera);
      if (present[camera]) continue;
      present[camera] = true;
      ++count;
      if (last[camera] > -1e299) gaps.push_back(rows.rows[j].time_s - last[camera]);
      last[camera] = rows.rows[j].time_s;
    }
    for (std::size_t c = 0; c < present.size(); ++c) {
      frames[c] += present[c] ? 1 : 0;
      shared[c] += present[c] && count > 1 ? 1 : 0;
    }
    i = j;
  }
  Rhythm rhythm;
  rhythm.period_s = quantileOf(gaps, 0.5);
  const auto share = [](long part, long all) { return static_cast<double>(part) / static_cast<double>(all); };
  const long all = std::accumulate(frames.begin(), frames.end(), 0L);
  if (all > 0) rhythm.shared_stamps = share(std::accumulate(shared.begin(), shared.end(), 0L), all);
  for (std::size_t c = 0; c < frames.size(); ++c)
    if (frames[c] >= kTellingFrames)
      rhythm.fewest_shared_stamps = std::min(rhythm.fewest_shared_stamps, share(shared[c], frames[c]));
  return rhythm;
}

std::vector<InstantRow> clusterInTime(const PointRows& rows, double window_s) {
  std::vector<InstantRow> out;
  out.reserve(rows.rows.size());
  std::int64_t instant = -1;
  double start = -1e300;
  for (std::size_t i = 0; i < rows.rows.size(); ++i) {
    const PointRow& row = rows.rows[i];
    if (row.time_s - start > window_s) {
      start = row.time_s;
      ++instant;
    }
    InstantRow& added = out.emplace_back();
    added.row = row;
    if (!rows.in_body.empty()) added.in_body = rows.in_body[i];
    added.instant = instant;
  }
  return out;
}

std::vector<InstantRow> interpolateInTime(const PointRows& rows, double period_s) {
  std::vector<InstantRow> out;
  if (rows.rows.empty() || !(period_s > 0.0)) return out;
  std::vector<std::size_t> order(rows.rows.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto key = [&](std::size_t i) {
    return trackKey(rows.rows[i], rows.in_body.empty() ? Eigen::Vector3d::Zero().eval() : rows.in_body[i]);
  };
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return key(a) < key(b); });
  const double start = rows.rows.front().time_s;
  for (std::size_t i = 0; i < order.size();) {
    std::size_t j = i;
    while (j < order.size() && key(order[i]) == key(order[j])) ++j;
    interpolateTrack(rows, std::span(order).subspan(i, j - i), start, period_s, out);
    i = j;
  }
  return out;
}

void measureMotion(std::vector<InstantRow>& rows, double period_s) {
  const auto key = [&](std::size_t i) { return trackKey(rows[i].row, rows[i].in_body); };
  std::vector<std::size_t> order(rows.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return key(a) < key(b); });
  for (std::size_t i = 0; i < order.size();) {
    std::size_t j = i;
    while (j < order.size() && key(order[i]) == key(order[j])) ++j;
    const auto at = [&](std::size_t k) -> const PointRow& { return rows[order[i + k]].row; };
    const Bridge bridge(j - i, period_s, [&](std::size_t k) { return at(k).pixel; });
    for (std::size_t k = 0; k < j - i; ++k) {
      const PointRow* before = k > 0 && bridge.holds(at(k - 1), at(k)) ? &at(k - 1) : nullptr;
      const PointRow* after = k + 1 < j - i && bridge.holds(at(k), at(k + 1)) ? &at(k + 1) : nullptr;
      rows[order[i + k]].motion = motionAt(before, at(k), after);
    }
    i = j;
  }
}

}  // namespace helical
