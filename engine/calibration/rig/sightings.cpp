#include "engine/calibration/rig/sightings.h"

#include <algorithm>
#include <numeric>

#include "engine/base/error.h"
#include "engine/calibration/rig/instants.h"

namespace helical {
namespace {

constexpr double kSynchronised = 0.3;      // share of equal time stamps from which on they are believed
constexpr double kOnItsOwn = 0.02;         // a camera with fewer of them has a rhythm of its own
constexpr double kSameInstant = 2e-6;      // s
constexpr double kStillPx = 2.0;           // a marker that stays within it stands still
constexpr std::size_t kMostPoints = 4000;  // more do not make it better, only slower
constexpr std::size_t kMostBodies = 1200;
constexpr std::size_t kRareCamera = 400;  // items of a camera that has fewer are all kept
// Hours of recording: every n-th stretch of so many periods is enough, but for what rarely seen cameras saw.
constexpr std::size_t kMostRows = 2'000'000;
constexpr std::size_t kRareRows = 20'000;
constexpr double kStretchPeriods = 32.0;

void sortByTime(PointRows& rows) {
  const auto earlier = [](const PointRow& a, const PointRow& b) { return a.time_s < b.time_s; };
  if (std::is_sorted(rows.rows.begin(), rows.rows.end(), earlier)) return;
  std::vector<std::uint32_t> order(rows.rows.size());
  std::iota(order.begin(), order.end(), 0U);
  std::stable_sort(order.begin(), order.end(),
                   [&](auto a, auto b) { return rows.rows[a].time_s < rows.rows[b].time_s; });
  PointRows sorted;
  sorted.markers = std::move(rows.markers);
  sorted.rows.reserve(order.size());
  for (const auto i : order) sorted.rows.push_back(rows.rows[i]);
  if (!rows.in_body.empty())
    for (const auto i : order) sorted.in_body.push_back(rows.in_body[i]);
  rows = std::move(sorted);
}

void thinStretches(PointRows& rows, std::size_t cameras, double period_s) {
  if (rows.rows.size() <= kMostRows || !(period_s > 0.0)) return;
  const auto by = static_cast<std::int64_t>(rows.rows.size() / kMostRows + 1);
  std::vector<std::size_t> seen(cameras, 0);
  for (const PointRow& row : rows.rows) ++seen[static_cast<std::size_t>(row.camera)];
  const double start = rows.rows.front().time_s, length = kStretchPeriods * period_s;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < rows.rows.size(); ++i) {
    const PointRow row = rows.rows[i];
    const auto stretch = static_cast<std::int64_t>(std::min(1e15, (row.time_s - start) / length));
    if (stretch % by != 0 && seen[static_cast<std::size_t>(row.camera)] >= kRareRows) continue;
    rows.rows[kept] = row;
    if (!rows.in_body.empty()) rows.in_body[kept] = rows.in_body[i];
    ++kept;
  }
  rows.rows.resize(kept);
  if (!rows.in_body.empty()) rows.in_body.resize(kept);
}

/// Whether every marker of every camera stays where it is, but for outliers.
bool standStill(const PointRows& rows, std::size_t cameras) {
  const std::size_t markers = rows.markers.size();
  if (markers < 2 || markers * cameras > 1'000'000) return false;
  std::vector<std::vector<float>> u(markers * cameras);
  for (const PointRow& row : rows.rows) {
    auto& track = u[static_cast<std::size_t>(row.marker) * cameras + static_cast<std::size_t>(row.camera)];
    if (track.size() < 512) track.push_back(static_cast<float>(row.pixel.x() + 0.37 * row.pixel.y()));
  }
  std::size_t repeated = 0;
  for (auto& track : u) {
    if (track.size() < 2) continue;
    ++repeated;
    std::sort(track.begin(), track.end());
    if (track[track.size() * 3 / 4] - track[track.size() / 4] > kStillPx) return false;
  }
  return repeated > 0;
}

/// One row stands for all of a camera's rows of a marker that stands still: the median one.
std::vector<InstantRow> stillInstants(const PointRows& rows) {
  std::vector<InstantRow> all = clusterInTime(rows, 1e300);
  for (InstantRow& row : all) row.instant = row.row.marker;
  const auto key = [](const InstantRow& r) { return std::pair(r.row.marker, r.row.camera); };
  std::stable_sort(all.begin(), all.end(), [&](const auto& a, const auto& b) { return key(a) < key(b); });
  std::vector<InstantRow> out;
  for (std::size_t i = 0; i < all.size();) {
    std::size_t j = i;
    std::vector<double> u, v;
    for (; j < all.size() && key(all[j]) == key(all[i]); ++j) {
      u.push_back(all[j].row.pixel.x());
      v.push_back(all[j].row.pixel.y());
    }
    const auto middle = static_cast<std::ptrdiff_t>(u.size() / 2);
    std::nth_element(u.begin(), u.begin() + middle, u.end());
    std::nth_element(v.begin(), v.begin() + middle, v.end());
    out.push_back(all[i]);
    out.back().row.pixel = {u[u.size() / 2], v[v.size() / 2]};
    i = j;
  }
  return out;
}

/// Which items to keep, evenly spread, with all of those that rarely seen cameras have.
std::vector<bool> thin(const std::vector<std::vector<std::int32_t>>& cameras_of_item, std::size_t cameras,
                       std::size_t most, int& by) {
  const std::size_t items = cameras_of_item.size();
  by = static_cast<int>(std::max<std::size_t>(1, (items + most - 1) / most));
  std::vector<std::size_t> seen(cameras, 0);
  for (const auto& item : cameras_of_item)
    for (const auto camera : item) ++seen[static_cast<std::size_t>(camera)];
  std::vector<bool> keep(items, false);
  for (std::size_t i = 0; i < items; ++i) {
    const bool rare = std::any_of(cameras_of_item[i].begin(), cameras_of_item[i].end(), [&](auto camera) {
      return seen[static_cast<std::size_t>(camera)] < kRareCamera;
    });
    keep[i] = rare || i % static_cast<std::size_t>(by) == 0;
  }
  return keep;
}

/// Makes items of rows that are sorted by item. A point that only one camera sees tells nothing; a body that
/// it sees at four points at least takes part in the residuals.
class TableMaker {
 public:
  TableMaker(TargetKind kind, Timing timing, double period_s, std::span<const RigCamera> cameras)
      : cameras_(cameras), rows_(cameras.size(), 0) {
    table_.stamps_after_s.assign(cameras.size(), 0.0);
    table_.kind = kind;
    table_.timing = timing;
    table_.period_s = period_s;
    table_.ambiguous.assign(cameras.size(), 0);
  }

  SightingTable make(std::vector<InstantRow> rows) {
    const bool body = table_.kind == TargetKind::kBody;
    const auto item_key = [body](const InstantRow& r) {
      return std::pair(r.instant, body ? 0 : r.row.marker);
    };
    std::sort(rows.begin(), rows.end(), [&](const InstantRow& a, const InstantRow& b) {
      if (item_key(a) != item_key(b)) return item_key(a) < item_key(b);
      if (a.row.camera != b.row.camera) return a.row.camera < b.row.camera;
      if (a.row.marker != b.row.marker) return a.row.marker < b.row.marker;
      return a.row.time_s < b.row.time_s;
    });
    std::vector<std::vector<InstantRow>> items;
    std::vector<std::vector<std::int32_t>> cameras_of_item;
    std::vector<InstantRow> item;
    for (std::size_t i = 0; i < rows.size();) {
      std::size_t j = i;
      item.clear();
      for (; j < rows.size() && item_key(rows[j]) == item_key(rows[i]); ++j) item.push_back(rows[j]);
      dropAmbiguous(item);
      std::vector<std::int32_t> seen;
      for (const InstantRow& r : item)
        if (seen.empty() || seen.back() != r.row.camera) seen.push_back(r.row.camera);
      if (seen.size() > 1 || (body && item.size() >= 4)) {
        items.push_back(item);
        cameras_of_item.push_back(std::move(seen));
      } else {
        table_.unmatched += static_cast<long>(item.size());
      }
      i = j;
    }
    const auto keep =
        thin(cameras_of_item, cameras_.size(), body ? kMostBodies : kMostPoints, table_.thinned_by);
    for (std::size_t i = 0; i < items.size(); ++i)
      if (keep[i]) add(items[i]);
    for (std::size_t c = 0; c < rows_.size(); ++c)
      table_.stamps_after_s[c] /= std::max(1.0, static_cast<double>(rows_[c]));
    return std::move(table_);
  }

 private:
  /// Several rows of one marker in one camera at one instant: which of them it is cannot be told.
  void dropAmbiguous(std::vector<InstantRow>& item) {
    std::vector<InstantRow> kept;
    for (std::size_t i = 0; i < item.size();) {
      std::size_t j = i;
      const auto same = [&](const InstantRow& r) {
        return r.row.camera == item[i].row.camera && r.row.marker == item[i].row.marker &&
               r.in_body == item[i].in_body;
      };
      while (j < item.size() && same(item[j])) ++j;
      if (j - i == 1)
        kept.push_back(item[i]);
      else
        table_.ambiguous[static_cast<std::size_t>(item[i].row.camera)] += static_cast<long>(j - i);
      i = j;
    }
    item = std::move(kept);
  }

  void add(const std::vector<InstantRow>& item) {
    double stamp_s = 0.0;
    for (const InstantRow& r : item) stamp_s += r.row.time_s / static_cast<double>(item.size());
    for (const InstantRow& r : item) {
      ++rows_[static_cast<std::size_t>(r.row.camera)];
      table_.stamps_after_s[static_cast<std::size_t>(r.row.camera)] += r.row.time_s - stamp_s;
      Sighting s;
      s.item = table_.items;
      s.camera = r.row.camera;
      s.marker = r.row.marker;
      s.pixel = r.row.pixel;
      s.bearing = cameras_[static_cast<std::size_t>(s.camera)].model.bearing(s.pixel);
      s.in_body = r.in_body;
      s.motion = r.motion;
      table_.sightings.push_back(s);
    }
    table_.item_time_s.push_back(item.front().row.time_s);
    ++table_.items;
  }

  std::span<const RigCamera> cameras_;
  SightingTable table_;
  std::vector<long> rows_;  ///< of each camera
};

}  // namespace

const char* nameOf(TargetKind kind) {
  switch (kind) {
    case TargetKind::kBody:
      return "a body with known points";
    case TargetKind::kMarkers:
      return "named markers that move";
    case TargetKind::kStillMarkers:
      return "named markers that stand still";
    case TargetKind::kLight:
      return "one waved light";
  }
  return "";
}

std::vector<SightingTable> bringTogether(PointRows& rows, std::span<const RigCamera> cameras,
                                         const std::string& file) {
  sortByTime(rows);
  const Rhythm rhythm = rhythmOf(rows, static_cast<int>(cameras.size()));
  thinStretches(rows, cameras.size(), rhythm.period_s);
  TargetKind kind = !rows.in_body.empty()          ? TargetKind::kBody
                    : rows.markers.front().empty() ? TargetKind::kLight
                                                   : TargetKind::kMarkers;
  if (kind == TargetKind::kMarkers && standStill(rows, cameras.size())) kind = TargetKind::kStillMarkers;
  const auto make = [&](Timing timing, std::vector<InstantRow> instants) {
    return TableMaker(kind, timing, rhythm.period_s, cameras).make(std::move(instants));
  };
  std::vector<SightingTable> tables;
  if (kind == TargetKind::kStillMarkers) {
    tables.push_back(make(Timing::kTogether, stillInstants(rows)));
  } else {
    const bool synchronised =
        rhythm.shared_stamps >= kSynchronised && rhythm.fewest_shared_stamps >= kOnItsOwn;
    if (!synchronised)
      tables.push_back(make(Timing::kInterpolated, interpolateInTime(rows, rhythm.period_s)));
    auto together = clusterInTime(rows, synchronised ? kSameInstant : 0.5 * rhythm.period_s);
    measureMotion(together, rhythm.period_s);
    tables.push_back(make(Timing::kTogether, std::move(together)));
  }
  std::erase_if(tables, [](const SightingTable& table) { return table.items == 0; });
  if (tables.empty())
    throw Error(ErrorKind::kInput, "no two cameras have rows of the same time", file,
                "give all cameras' times on one clock, and let at least two of them see the target at once");
  return tables;
}

}  // namespace helical
