#pragma once

#include <cstdint>
#include <vector>

#include "engine/geometry/camera_model.h"
#include "engine/geometry/rigid_transform.h"
#include "engine/helicopter/marker_layout.h"
#include "engine/simulator/scene_noise.h"
#include "engine/simulator/scene_renderer.h"
#include "engine/simulator/scene_shapes.h"

namespace helical {

/// Draws the helicopter, its marker balls and its turning rotors into a camera's picture, in true depth order
/// and with smooth edges. Its looks are the XRB's, roughly: they have no part in the dynamics. Allocates in
/// the constructor only. One thread.
class SceneHelicopter {
 public:
  SceneHelicopter(const CameraModel& model, const MarkerLayout& markers_in_body);

  /// `bgr`: packed rows of the camera's size; `gain`: brightness of the light.
  void draw(const RigidTransform& camera_from_world, const HelicopterView& view, double gain,
            SceneNoise& noise, std::uint8_t* bgr);

 private:
  void build(const RigidTransform& camera_from_body, const HelicopterView& view);
  void addBody();
  void addMarkers();
  void addRotors(const HelicopterView& view);
  void addEllipsoid(const Eigen::Vector3d& centre, const Eigen::Vector3d& radii, const Surface& surface);
  void addRod(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius, const Surface& surface);
  void drawStrip(const PixelRect& area, const Eigen::Vector3d& light);
  void resolve(double gain, SceneNoise& noise, std::uint8_t* bgr);

  CameraModel model_;
  MarkerLayout markers_;
  SampleStrip strip_;
  RigidTransform camera_from_body_;
  Eigen::Matrix3d body_axes_;
  PixelRect rect_;
  std::vector<EllipsoidShape> ellipsoids_;
  std::vector<RodShape> rods_;
  std::vector<RotorShape> rotors_;  ///< the farther one first
};

}  // namespace helical
