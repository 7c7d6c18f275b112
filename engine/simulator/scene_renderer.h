#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "engine/cameras/frame.h"
#include "engine/geometry/camera_model.h"
#include "engine/geometry/rigid_transform.h"
#include "engine/helicopter/marker_layout.h"

namespace helical {

/// Where the helicopter is at an exposure.
struct HelicopterView {
  RigidTransform world_from_body;
  double upper_rotor_angle = 0.0;  ///< rad, about the body's z axis
  double lower_rotor_angle = 0.0;
};

struct SceneOptions {
  std::uint64_t seed = 1;
  double image_noise = 2.0;  ///< grey levels, standard deviation
  double light_drift =
      0.05;  ///< relative amplitude of a slow change of brightness, half a minute from end to end
};

/// What one simulated camera sees: a furnished room, the helicopter in it with its marker balls, sensor
/// noise. Only the helicopter's surroundings are drawn per frame; the room is rendered in the first `render`
/// and again whenever the camera has moved. Repeats for a seed and the same sequence of calls. Allocates in
/// the constructor only. One thread.
class SceneRenderer {
 public:
  SceneRenderer(const CameraModel& model, const MarkerLayout& markers_in_body, const SceneOptions& options);
  ~SceneRenderer();
  SceneRenderer(SceneRenderer&&) noexcept;
  SceneRenderer& operator=(SceneRenderer&&) noexcept;

  /// The picture at `time_s`, valid until the next call. `helicopter`: nothing for the empty field. `board`:
  /// how much of the picture a white board covers, from the left; 1 covers all.
  ImageView render(const RigidTransform& camera_from_world, const std::optional<HelicopterView>& helicopter,
                   double time_s, double board = 0.0);

 private:
  struct Workspace;
  std::unique_ptr<Workspace> workspace_;
};

}  // namespace helical
