#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <QColor>
#include <QImage>
#include <QPointF>
#include <QString>
#include <memory>
#include <vector>

#include "engine/geometry/camera_model.h"
#include "engine/geometry/rigid_transform.h"
#include "engine/helicopter/helicopter_parameters.h"
#include "engine/helicopter/marker_layout.h"
#include "ui/waypoint_drag.h"

namespace helical {

struct SceneCamera {
  QString name;
  QColor color;
  CameraModel model;
};

/// What stays the same for the whole session.
struct SceneSetup {
  std::vector<SceneCamera> cameras;
  MarkerLayout markers;
  HelicopterParameters helicopter;
  double fence_radius = 0.0;  ///< m from the pad's centre
  double fence_height = 0.0;  ///< m above the pad
};

/// A line from a camera through a marker it sees.
struct SceneRay {
  int camera = 0;
  Eigen::Vector3d from = Eigen::Vector3d::Zero();
  Eigen::Vector3d to = Eigen::Vector3d::Zero();
};

/// How far from a camera its view is drawn [m].
inline constexpr double kFrustumLength = 0.45;

struct SceneCameraPose {
  bool known = false;
  bool in_use = false;  ///< calibrated and not hidden
  RigidTransform camera_from_world;
  bool has_truth = false;  ///< a place that is being learnt, and it is known where the camera truly is
  RigidTransform true_camera_from_world;
  bool has_spread = false;  ///< three standard deviations of what is believed
  Eigen::Quaterniond spread_axes = Eigen::Quaterniond::Identity();  ///< world from the ellipsoid's axes
  Eigen::Vector3d spread_radii = Eigen::Vector3d::Zero();           ///< m
  double spread_angle = 0.0;                                        ///< of the optical axis [rad]
};

/// One hypothesis of where a camera is.
struct SceneParticle {
  int camera = 0;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  double weight = 0.0;  ///< over that of the heaviest
};

enum class Presence { kAbsent, kLastKnown, kTracked };

/// Everything that moves, in the world frame [m]; travels to the render thread by value.
struct SceneFrame {
  Presence presence = Presence::kAbsent;
  RigidTransform world_from_body;
  double floor_height = 0.0;
  double upper_angle = 0.0;  ///< of the rotors, for show: the engine knows only the demand [rad]
  double lower_angle = 0.0;
  double upper_demand = 0.0;  ///< 0..1
  double lower_demand = 0.0;
  bool has_set_point = false;
  Eigen::Vector3d set_point = Eigen::Vector3d::Zero();
  std::vector<Eigen::Vector3d> trail;  ///< oldest first
  std::vector<SceneCameraPose> cameras;
  std::vector<SceneRay> rays;
  std::vector<SceneParticle> particles;
  std::shared_ptr<const std::vector<Eigen::Vector3d>> coverage;  ///< lines, two points each; null: not shown
  std::vector<Eigen::Vector3d> plan;  ///< waypoints of the helicopter's origin, in flying order
  bool plan_is_draft = false;         ///< not in force yet
  int meant_waypoint = -1;            ///< under the mouse; -1: none
  double field_of_view = 0.61;        ///< vertical [rad]
  double fence_nearness = 0.0;        ///< 0 far from the fence, 1 at it
  Eigen::Vector3d eye = Eigen::Vector3d::UnitX();
  Eigen::Vector3d focus = Eigen::Vector3d::Zero();
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
};

/// A word to be painted over the picture, at widget coordinates.
struct SceneLabel {
  QPointF position;
  int camera = 0;
  bool in_use = false;
};

struct RenderedScene {
  QImage image;
  std::vector<SceneLabel> labels;
  double milliseconds = 0.0;
  SceneProjection projection;         ///< of this picture
  std::vector<Eigen::Vector3d> plan;  ///< the waypoints in it
};

}  // namespace helical
