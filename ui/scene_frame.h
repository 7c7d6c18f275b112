#pragma once

#include <Eigen/Core>
#include <QColor>
#include <QImage>
#include <QPointF>
#include <QString>
#include <vector>

#include "engine/geometry/camera_model.h"
#include "engine/geometry/rigid_transform.h"
#include "engine/helicopter/helicopter_parameters.h"
#include "engine/helicopter/marker_layout.h"

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
};

/// A line from a camera through a marker it sees.
struct SceneRay {
  int camera = 0;
  Eigen::Vector3d from = Eigen::Vector3d::Zero();
  Eigen::Vector3d to = Eigen::Vector3d::Zero();
};

struct SceneCameraPose {
  bool known = false;
  bool in_use = false;  ///< calibrated and not hidden
  RigidTransform camera_from_world;
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
};

}  // namespace helical
