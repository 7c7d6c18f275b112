#include "engine/calibration/rig/rig_state.h"

namespace helical {

std::size_t timeKeeper(const RigState& state) {
  std::size_t first = state.fixed.size();
  for (std::size_t c = state.fixed.size(); c-- > 0;)
    if (state.camera_from_world[c]) first = c;
  for (std::size_t c = state.fixed.size(); c-- > 0;)
    if (state.camera_from_world[c] && state.fixed[c]) first = c;
  return first;
}

std::optional<Eigen::Vector3d> pointInWorld(const RigState& state, const SightingTable& table,
                                            const Sighting& s) {
  const auto item = static_cast<std::size_t>(s.item);
  if (table.kind != TargetKind::kBody) return state.points[item];
  if (!state.world_from_body[item]) return std::nullopt;
  return *state.world_from_body[item] * s.in_body;
}

std::optional<Eigen::Vector2d> sightingResidual(const RigState& state, std::span<const RigCamera> cameras,
                                                const SightingTable& table, const Sighting& s) {
  const auto camera = static_cast<std::size_t>(s.camera);
  const auto& pose = state.camera_from_world[camera];
  const auto point = pointInWorld(state, table, s);
  if (!pose || !point) return std::nullopt;
  const auto pixel = cameras[camera].model.project(*pose * *point);
  if (!pixel) return std::nullopt;
  return s.pixel - *pixel;
}

void moveWorld(RigState& state, const RigidTransform& new_from_old, double scale) {
  const RigidTransform old_from_new = new_from_old.inverse();
  for (auto& pose : state.camera_from_world) {
    if (!pose) continue;
    pose = *pose * old_from_new;
    pose->translation *= scale;
  }
  for (auto& point : state.points)
    if (point) point = scale * (new_from_old * *point);
  for (auto& pose : state.world_from_body) {
    if (!pose) continue;
    pose = new_from_old * *pose;
    pose->translation *= scale;
  }
}

std::vector<std::size_t> itemStarts(const SightingTable& table) {
  std::vector<std::size_t> starts(static_cast<std::size_t>(table.items) + 1, table.sightings.size());
  for (std::size_t i = table.sightings.size(); i-- > 0;)
    starts[static_cast<std::size_t>(table.sightings[i].item)] = i;
  return starts;
}

}  // namespace helical
