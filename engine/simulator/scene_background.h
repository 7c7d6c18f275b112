#pragma once

#include <cstdint>
#include <vector>

#include "engine/geometry/camera_model.h"
#include "engine/geometry/rigid_transform.h"
#include "engine/simulator/scene_noise.h"

namespace helical {

/// The room without the helicopter as one camera sees it, through its lens: rendered once per camera pose,
/// kept in some copies that have noise already, so that a frame costs one copy of memory. The light drifts:
/// each frame renews some rows. Allocates in the constructor only. One thread.
class SceneBackground {
 public:
  SceneBackground(const CameraModel& model, Random random);

  /// Renders the room anew for another camera pose.
  void setPose(const RigidTransform& camera_from_world, double gain, SceneNoise& noise);

  /// Renews some rows with this brightness and copies one of the noisy pictures to `bgr` (packed rows).
  void copyTo(std::uint8_t* bgr, double gain, SceneNoise& noise);

  bool isFloor(int x, int y) const { return is_floor_[index(x, y)] != 0; }

 private:
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
  }
  void prepareBearings(const CameraModel& model);
  Eigen::Vector2d bearing(double x, double y) const;
  void renderRow(int y, const RigidTransform& camera_from_world);
  void renewRow(int copy, int y, double gain, SceneNoise& noise);

  int width_;
  int height_;
  int grid_width_;
  Random random_;
  std::vector<Eigen::Vector2d> grid_;  ///< bearings at every eighth pixel
  std::vector<std::uint16_t> clean_;   ///< without noise, 1/64 grey levels
  std::vector<std::uint8_t> is_floor_;
  std::vector<std::vector<std::uint8_t>> noisy_;
  int shown_ = 0;
  int next_copy_ = 0;
  int next_row_ = 0;
};

}  // namespace helical
