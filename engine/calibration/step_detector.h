#pragma once

#include <array>
#include <span>

#include "engine/calibration/moment_maker.h"

namespace helical {

struct StepDetectorOptions {
  double alarm_chi2 = 32.0;    ///< that a step of one camera of three must explain
  double margin_chi2 = 12.0;   ///< by which it must explain more than a step of any other camera
  double rest_chi2 = 4.5;      ///< per other camera: more that stays unexplained is no knock of one camera
  double floor_px = 0.02;      ///< of a step, per axis, beside the noise of its centroids
  double smallest_px = 0.2;
  double jerk_m_s3 = 5.0;      ///< the largest of the helicopter, which a step must not be taken for
};

/// Throws Error(kInput) naming the offending key.
void validate(const StepDetectorOptions& options);

/// Knocks too small to throw the balls out of their gates: a camera that turns by a twentieth of a degree
/// moves all of them by half a pixel at once, which no helicopter can. Each camera's images are looked at by
/// themselves: along each ball's track a parabola and a step are fitted, a step near its end for large knocks, which
/// then are found within two frames, and one farther from it for small ones; the mean of the steps of balls that this
/// fits is the camera's. A jerk of the helicopter looks like a step, too, but in all
/// cameras, as one shift in space. So the steps s_i = H_i x + n_i of all cameras are weighed together, x ~
/// N(0, what it has lately been), and the camera whose own step, free, explains most is named when nothing is
/// left over for the others to explain, twice in a row and while all tracks are smooth. Offsets that change
/// slowly, errors of calibration among them, are no steps. Needs three cameras: of two none is named.
///
/// What can be found: of white noise of 0.08 px the longest window makes a step of 0.05 px, so that `alarm_chi2` asks
/// for 0.28 px; three camera-hours are two million looks, of which chance alone lets one in exp(16) pass, nine million.
/// With more cameras, or where noise has just risen, as much more is asked for as keeps that true.
/// One thread; allocates nothing.
class StepDetector {
 public:
  explicit StepDetector(const StepDetectorOptions& options = {});

  /// One frame of one camera; `d_world`: how its pixels move with the helicopter's place [px/m]. The index of the
  /// camera that was knocked, or -1.
  int add(CameraId camera, const NamedBalls& balls, const Eigen::Matrix<double, 2, 3>& d_world);
  /// What this camera showed counts no more.
  void forget(CameraId camera);

 private:
  /// Frames of a track before the step and after it.
  struct Window {
    int before, after;
  };
  // So many frames before the step, for those after it, that the second and third hardly take a jerk for one.
  static constexpr std::array<Window, 3> kWindows{{{8, 2}, {10, 4}, {16, 6}}};
  static constexpr int kKept = 22;
  struct Step {
    TimeNs time = 0;
    bool known = false;
    Eigen::Vector2d pixels = Eigen::Vector2d::Zero();
    double variance = 0.0;     ///< per axis
    double misfit = 0.0;       ///< variance that the fits leave over what is expected
    double freedoms = 0.0;     ///< that this rests on
    double of_jerk_s3 = 0.0;   ///< step that the fit takes a unit jerk for
  };
  struct Camera {
    std::array<NamedBalls, kKept> frames;
    int count = 0, next = 0;
    Eigen::Matrix<double, 2, 3> d_world = Eigen::Matrix<double, 2, 3>::Zero();
    double noise = 1.0;  ///< variance of its centroids over what they claim, learnt
    std::array<Step, kWindows.size()> steps;
    const NamedBalls& ago(int frames_ago) const;
  };

  /// The shift of the helicopter that steps of these cameras look like, and what it leaves over.
  struct Motion {
    Eigen::Vector3d shift = Eigen::Vector3d::Zero();
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
    double chi2 = 0.0;
  };

  Step measure(const Camera& camera, const Window& window) const;
  static void learnNoise(Camera& camera, const Step& step);
  Motion motionOf(std::span<const std::size_t> cameras, std::size_t window, double prior_m2) const;
  int judge(std::size_t newest, std::size_t window);
  bool confirmed(int suspect, TimeNs now);

  StepDetectorOptions options_;
  std::array<Camera, kMaxCameras> cameras_;
  std::array<double, kWindows.size()> usual_motion_m2_{};  ///< per axis, as such a window sees it; 0: not known yet
  int suspect_ = -1;  ///< whom the last verdict named
  TimeNs suspected_at_ = 0;
};

}  // namespace helical
