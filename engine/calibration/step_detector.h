#pragma once

#include <array>

#include "engine/calibration/moment_maker.h"

namespace helical {

struct StepDetectorOptions {
  double alarm_chi2 = 32.0;    ///< that a step of one camera must explain
  double margin_chi2 = 12.0;   ///< by which it must explain more than a step of any other camera
  double rest_chi2 = 4.5;      ///< per other camera: more that stays unexplained is no knock of one camera
  double floor_px = 0.03;      ///< of a step, per axis, beside the noise of its centroids
  double smallest_px = 0.2;
  double jerk_m_s3 = 5.0;      ///< of the helicopter, which a step must not be taken for
};

/// Throws Error(kInput) naming the offending key.
void validate(const StepDetectorOptions& options);

/// Knocks too small to throw the balls out of their gates: a camera that turns by a twentieth of a degree moves all of
/// them by half a pixel at once, which no helicopter can. Each camera's images are looked at by themselves: along
/// each ball's track of 8 and of 12 frames a parabola and a step in the middle are fitted; the median of the
/// steps of balls that this fits is the camera's. A jerk of the helicopter looks like a step, too, but in all cameras, as one shift in
/// space. So the steps s_i = H_i x + n_i of all cameras are weighed together, x ~ N(0, jerk), and the camera whose
/// own step, free, explains most is named when nothing is left over for the others to explain, twice in a row and
/// while all tracks are smooth. Offsets that change
/// slowly, errors of calibration among them, are no steps. Needs three cameras: of two none is named. One thread;
/// allocates nothing.
class StepDetector {
 public:
  explicit StepDetector(const StepDetectorOptions& options = {});

  /// One frame of one camera; `d_world`: how its pixels move with the helicopter's place [px/m]. The index of the
  /// camera that was knocked, or -1.
  int add(CameraId camera, const NamedBalls& balls, const Eigen::Matrix<double, 2, 3>& d_world);
  /// What this camera showed counts no more.
  void forget(CameraId camera);

 private:
  static constexpr std::array<int, 2> kSides{4, 6};  ///< frames before and after
  static constexpr int kKept = 12;
  struct Step {
    TimeNs time = 0;
    bool known = false;
    Eigen::Vector2d pixels = Eigen::Vector2d::Zero();
    double variance = 0.0;  ///< per axis
    double misfit = 0.0;    ///< variance that the fits leave over what is expected
  };
  struct Camera {
    std::array<NamedBalls, kKept> frames;
    int count = 0, next = 0;
    Eigen::Matrix<double, 2, 3> d_world = Eigen::Matrix<double, 2, 3>::Zero();
    std::array<Step, kSides.size()> steps;
    const NamedBalls& ago(int frames_ago) const;
  };

  Step measure(const Camera& camera, int side) const;
  int judge(std::size_t newest, std::size_t scale) const;
  bool confirmed(int suspect, TimeNs now);

  StepDetectorOptions options_;
  std::array<Camera, kMaxCameras> cameras_;
  int suspect_ = -1;  ///< whom the last verdict named
  TimeNs suspected_at_ = 0;
};

}  // namespace helical
