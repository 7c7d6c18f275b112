#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "engine/calibration/rig/rig_camera.h"
#include "engine/calibration/rig/sightings.h"
#include "engine/geometry/rigid_transform.h"

namespace helical {

/// What a rig calibration estimates. Of a body's recording `world_from_body` is in use, else `points`; items
/// without a value are left out.
struct RigState {
  std::vector<std::optional<RigidTransform>> camera_from_world;
  std::vector<std::optional<Eigen::Vector3d>> points;  ///< in the world
  std::vector<std::optional<RigidTransform>> world_from_body;
  std::vector<bool> fixed;  ///< cameras whose given pose stands

  int solvedCameras() const;
};

/// The camera whose delay is zero: the first one whose pose is given, else the first one that has a pose.
std::size_t timeKeeper(const RigState& state);

inline int RigState::solvedCameras() const {
  int count = 0;
  for (const auto& camera : camera_from_world) count += camera.has_value() ? 1 : 0;
  return count;
}

/// Where the state puts a sighting's point in the world; nothing if it does not know.
std::optional<Eigen::Vector3d> pointInWorld(const RigState& state, const SightingTable& table,
                                            const Sighting& s);

/// Seen less predicted pixel; nothing where the state has no camera or item, or the point is out of the
/// model.
std::optional<Eigen::Vector2d> sightingResidual(const RigState& state, std::span<const RigCamera> cameras,
                                                const SightingTable& table, const Sighting& s);

/// Moves the whole solution: world_new = scale * (new_from_old * world_old).
void moveWorld(RigState& state, const RigidTransform& new_from_old, double scale);

/// First row of each item, and one past the last item's last row.
std::vector<std::size_t> itemStarts(const SightingTable& table);

}  // namespace helical
