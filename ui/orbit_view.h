#pragma once

#include <Eigen/Core>
#include <vector>

namespace helical {

enum class SceneViewpoint { kFollow, kTop, kIso };

/// The eye of the 3D scene: it circles a focus in the world [m, rad]. A plain value; no drawing.
class OrbitView {
 public:
  OrbitView();

  /// What Top and Iso show all of, in a picture of this width over height. They move when it changes, unless somebody
  /// has turned or moved them by hand.
  void setField(const std::vector<Eigen::Vector3d>& points, double aspect);

  void look(SceneViewpoint viewpoint);
  SceneViewpoint viewpoint() const { return viewpoint_; }

  void turn(double azimuth, double elevation);  ///< rad
  void zoom(double factor);                     ///< of the distance
  void pan(double right, double up);            ///< in fractions of the view's height
  /// Where the helicopter is; Follow keeps it in the middle, the other views do not care.
  void track(const Eigen::Vector3d& helicopter);

  Eigen::Vector3d eye() const;
  const Eigen::Vector3d& focus() const { return focus_; }
  Eigen::Vector3d up() const;

  static constexpr double kFieldOfView = 0.61;  ///< rad, vertical

 private:
  /// As near as all of the field can be seen from this side, in the middle.
  void fit();
  double fittingDistance() const;

  std::vector<Eigen::Vector3d> field_;
  double aspect_ = 1.5;
  bool by_hand_ = false;
  SceneViewpoint viewpoint_ = SceneViewpoint::kFollow;
  Eigen::Vector3d focus_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d offset_ = Eigen::Vector3d::Zero();  ///< panned away from the helicopter in Follow
  double azimuth_ = 0.0;
  double elevation_ = 0.0;
  double distance_ = 1.0;
};

}  // namespace helical
