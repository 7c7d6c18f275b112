#include "engine/calibration/rig/chain_bodies.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "engine/calibration/rig/body_views.h"
#include "engine/calibration/rig/point_structure.h"
#include "engine/calibration/rig/rig_bundle.h"

namespace helical {
namespace {

constexpr double kSameRotation = 0.06;  // rad
constexpr double kSamePlace = 0.06;     // of the distance to the body
constexpr std::size_t kMostCandidates = 120;
constexpr int kFewestCommonViews = 2;

/// How b stands to a, by one view of the body that both have.
struct Candidate {
  RigidTransform b_from_a;
  double distance_m = 0.0;
};

bool agree(const Candidate& p, const Candidate& q) {
  return p.b_from_a.rotation.angularDistance(q.b_from_a.rotation) < kSameRotation &&
         (p.b_from_a.translation - q.b_from_a.translation).norm() <
             kSamePlace * std::max(p.distance_m, q.distance_m);
}

struct Link {
  std::size_t a = 0, b = 0;
  RigidTransform b_from_a;
  int views = 0;
};

using ViewsOfItem = std::map<std::int32_t, std::vector<const BodyView*>>;

std::optional<Link> link(std::size_t a, std::size_t b, const ViewsOfItem& items) {
  std::vector<std::vector<Candidate>> of_item;
  for (const auto& [item, views] : items) {
    const BodyView *in_a = nullptr, *in_b = nullptr;
    for (const BodyView* view : views) {
      if (static_cast<std::size_t>(view->camera) == a) in_a = view;
      if (static_cast<std::size_t>(view->camera) == b) in_b = view;
    }
    if (in_a == nullptr || in_b == nullptr) continue;
    of_item.emplace_back();
    for (const RigidTransform& p : in_a->camera_from_body)
      for (const RigidTransform& q : in_b->camera_from_body)
        of_item.back().push_back({q * p.inverse(), std::max(p.translation.norm(), q.translation.norm())});
  }
  Link best{a, b, {}, 0};
  const std::size_t by = of_item.size() / kMostCandidates + 1;
  for (std::size_t i = 0; i < of_item.size(); i += by) {
    for (const Candidate& candidate : of_item[i]) {
      const int views =
          static_cast<int>(std::count_if(of_item.begin(), of_item.end(), [&](const auto& others) {
            return std::any_of(others.begin(), others.end(),
                               [&](const Candidate& o) { return agree(candidate, o); });
          }));
      if (views > best.views) best = {a, b, candidate.b_from_a, views};
    }
  }
  if (best.views < std::min<int>(kFewestCommonViews, static_cast<int>(of_item.size())) || best.views == 0)
    return std::nullopt;
  return best;
}

/// Poses along the tree of strongest links, from the camera that has most of them.
void poseCameras(std::vector<Link> links, RigState& state) {
  if (links.empty()) return;
  std::stable_sort(links.begin(), links.end(),
                   [](const Link& p, const Link& q) { return p.views > q.views; });
  state.camera_from_world[links.front().a] = RigidTransform{};
  for (bool grew = true; grew;) {
    grew = false;
    for (const Link& l : links) {
      auto &a = state.camera_from_world[l.a], &b = state.camera_from_world[l.b];
      if (a.has_value() == b.has_value()) continue;
      if (a)
        b = l.b_from_a * *a;
      else
        a = l.b_from_a.inverse() * *b;
      grew = true;
      break;
    }
  }
}

double errorOf(const RigState& state, std::span<const RigCamera> cameras, const SightingTable& table,
               std::span<const Sighting> sightings, double tolerance_px) {
  double sum = 0.0;
  for (const Sighting& s : sightings) {
    const auto r = sightingResidual(state, cameras, table, s);
    sum += std::min(r ? r->squaredNorm() : 1e12, tolerance_px * tolerance_px);
  }
  return sum;
}

/// Of each item the pose, by any of its views, that most of its sightings agree with.
void poseBodies(RigState& state, std::span<const RigCamera> cameras, const SightingTable& table,
                const ViewsOfItem& items, double tolerance_px) {
  const auto starts = itemStarts(table);
  for (const auto& [item, views] : items) {
    const auto i = static_cast<std::size_t>(item);
    const auto sightings = std::span(table.sightings).subspan(starts[i], starts[i + 1] - starts[i]);
    std::optional<RigidTransform> best;
    double least = 1e300;
    for (const BodyView* view : views) {
      const auto& camera = state.camera_from_world[static_cast<std::size_t>(view->camera)];
      if (!camera) continue;
      for (const RigidTransform& pose : view->camera_from_body) {
        state.world_from_body[i] = camera->inverse() * pose;
        const double error = errorOf(state, cameras, table, sightings, tolerance_px);
        if (error >= least) continue;
        least = error;
        best = state.world_from_body[i];
      }
    }
    state.world_from_body[i] = best;
  }
}

}  // namespace

RigState chainBodies(std::span<const RigCamera> cameras, SightingTable& table, double tolerance_px,
                     const ProgressCallback& progress) {
  RigState state;
  state.camera_from_world.resize(cameras.size());
  state.points.resize(static_cast<std::size_t>(table.items));
  state.world_from_body.resize(state.points.size());
  state.fixed.assign(cameras.size(), false);
  const std::vector<BodyView> views = poseBodyViews(cameras, table, tolerance_px);
  if (progress) progress(0.4);
  ViewsOfItem items;
  for (const BodyView& view : views) items[view.item].push_back(&view);
  std::vector<Link> links;
  for (std::size_t a = 0; a < cameras.size(); ++a)
    for (std::size_t b = a + 1; b < cameras.size(); ++b)
      if (const auto found = link(a, b, items)) links.push_back(*found);
  poseCameras(std::move(links), state);
  if (progress) progress(0.6);
  poseBodies(state, cameras, table, items, 4.0 * tolerance_px);
  for (const double wider : {4.0, 2.0}) {
    gateSightings(state, cameras, table, wider * tolerance_px, 3);
    adjustBundle(state, cameras, table, {0.5 * tolerance_px, 40, false});
  }
  gateSightings(state, cameras, table, tolerance_px, 3);
  return state;
}

}  // namespace helical
