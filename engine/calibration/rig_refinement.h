#pragma once

#include <array>
#include <bitset>
#include <span>
#include <vector>

#include "engine/calibration/moment_maker.h"
#include "engine/calibration/rig_bundle.h"
#include "engine/calibration/self_calibration_options.h"
#include "engine/calibration/thinned_store.h"

namespace helical {

struct RigRefinementOptions {
  double spacing_s = 0.1;     ///< between the moments that are kept, at least
  int moments = 256;          ///< kept; the most redundant makes room
  int fewest_moments = 24;    ///< before anything is solved
  int fewest_of_camera = 12;  ///< moments in which a camera must have seen the helicopter
  double good_inliers = 0.7;  ///< share of a camera's balls that must fit
  double good_ball = 0.5;     ///< share of a ball's images that must
  double good_median = 3.0;   ///< standard deviations that the median residual may have; 1.2 is expected
  SelfCalibrationOptions self;
  double farthest_sigmas =
      4.0;  ///< of the priors, that balls and focal lengths may be off, each and all together
  // That the helicopter's pose, by all or by one camera in control, may jump by it, median: four of the
  // standard deviations, 0.02 m and 0.01 rad, by which the filter that flies opens for it. Its gate is
  // at 4.2: farther off images would be refused and not followed.
  double farthest_m = 0.08, farthest_rad = 0.04;
  double lasting_sigma_px = 0.08, lasting_time_s = 1.0;  ///< see LastingOffsets
};

/// Throws Error(kInput) naming the offending key.
void validate(const RigRefinementOptions& options);

/// All cameras of a rig solved for together, on demand, from what they saw of the helicopter in this flight:
/// each learns for itself otherwise, which is quick and loses a tenth of what the frames hold. Looks on all
/// the time and keeps moments spread over the helicopter's poses; solves in slices of bounded work, so that
/// no image waits for it. One thread; allocates at construction only.
///
/// If the options say so, balls and focal lengths are solved for, too (RigBundle has how the gauge is held).
/// They correct what is flown with only if they explain the images better than chance does, every camera
/// fits, they are off no farther than their priors allow, and the helicopter does not jump; otherwise all is
/// solved for once more without them, and the answer is as if nobody had asked. A focal length that the
/// images hardly tell stays as it is, and a learning camera that does not fit takes no part: that is found in
/// runs of their own. The priors are about the rig's values however often it is done, and no image counts
/// twice: nothing creeps. What was found stays until later images contradict it or tell far more: those that
/// told it are gone, and new ones of less weight would only add their noise. Cameras alone may let the pose
/// jump no farther than balls may.
class RigRefinement {
 public:
  /// What is known of one camera when it starts.
  struct Part {
    CameraEstimate estimate;
    bool used = false;
    bool holds = false;   ///< its pose is known up to its covariance, and with it the world
    bool frozen = false;  ///< nothing will be learnt about it: it stays, and its focal length
    bool hidden = false;  ///< it sees, but nobody flies by it
  };

  RigRefinement(const std::vector<CameraModel>& cameras, const MarkerLayout& markers,
                const RigRefinementOptions& options = {});

  /// The balls that a camera saw, and about where the helicopter was.
  void see(CameraId camera, const NamedBalls& balls, const RigidTransform& world_from_body);
  /// It was moved: what it saw before counts no more.
  void forget(CameraId camera);
  /// What was seen so far is in what is flown with now.
  void startAfresh();

  /// Null, or why it cannot be done: a literal.
  const char* start(std::span<const Part> cameras);
  void stop() { bundle_.stop(); }
  bool running() const { return bundle_.running(); }

  /// What a run that ended has to say about balls and focal lengths.
  enum class Correction {
    kNotSought,
    kFound,          ///< `markers` and `focalScale` are new, and the poses in its answers hold with these
    kNotNeeded,      ///< images are explained as well by what is flown with
    kUnsound,        ///< something else is wrong
    kTooFar,         ///< the helicopter would jump
    kNoAnswer,       ///< of any kind: nothing is to be changed
    kCamerasTooFar,  ///< nor here: by the cameras' new poses alone the helicopter would jump
  };
  Correction correction() const { return correction_; }
  /// Whether it takes part in a run that goes on: what happens to it now spoils the run for all.
  bool uses(CameraId camera) const {
    return running() && asked_[static_cast<std::size_t>(camera.index())].used;
  }
  /// Balls of which the run that ended knows little, for they hardly ever were where the pose said.
  int ballsHardlySeen() const;
  /// What is flown with.
  const MarkerLayout& markers() const { return markers_; }
  double focalScale(CameraId camera) const { return focal_scales_[static_cast<std::size_t>(camera.index())]; }
  /// A camera's focal lengths are the model's times this, whatever was found; priors are about it from here
  /// on.
  void setFocalScale(CameraId camera, double scale) {
    const auto index = static_cast<std::size_t>(camera.index());
    focal_scales_[index] = said_scales_[index] = scale;
  }

  /// One observation's share of the work. True when it ended just now.
  bool work();

  /// Of a run that ended: whether it has an answer.
  bool succeeded() const;
  /// Of a run that ended: where it found this camera. Status kCalibrated; kUncalibrated for one that it could
  /// not find, or that held the world exactly.
  CameraEstimate answer(CameraId camera) const;

 private:
  void keep(TimeNs now, const RigidTransform& world_from_body);
  void solve(const SelfCalibrationOptions& self);
  /// Takes out of the run what it cannot tell. True if there was something.
  bool leaveOutWhatIsOpen();
  Correction judgeCorrection();
  bool everyBallFits() const;
  bool isWithinPriors() const;
  void takeCorrection();
  /// The helicopter, by all cameras together.
  bool poseJumpsTooFar();
  /// The helicopter as one of the cameras in control sees it by itself, balls as they are.
  bool someCameraJumpsTooFar();
  bool hasAnswer(std::size_t camera) const;
  /// `pose_after(i)`: where the helicopter was at moment i, of `flown_`.
  template <typename PoseAfter>
  bool jumpsTooFar(const PoseAfter& pose_after);

  RigRefinementOptions options_;
  std::size_t cameras_;
  MomentMaker maker_;
  ThinnedStore<RigMoment> store_;
  TimeNs last_kept_ = 0;
  RigMoment moment_;
  std::vector<RigMoment> solved_;  ///< what the bundle works on
  std::size_t solved_count_ = 0;
  RigBundle bundle_;
  std::vector<BundleCamera> asked_;      ///< as it was started
  std::vector<BundleCamera> start_;      ///< of this run
  std::bitset<kMaxCameras> in_control_;  ///< of those asked for
  MarkerLayout markers_, said_markers_;  ///< flown with, and what the rig says
  std::array<double, kMaxCameras> focal_scales_, said_scales_;
  std::vector<RigidTransform> flown_;  ///< where the tracker had the helicopter at those moments
  std::vector<double> jumps_;          ///< scratch
  double inflation_ = 1.0;             ///< of variances, by offsets that last
  bool correcting_ = false;            ///< balls or focal lengths are unknowns of this run
  bool found_before_ = false;          ///< what is flown with is as noisy as images are
  Correction correction_ = Correction::kNotSought;
  bool other_unknowns_ = false;  ///< than balls and focal lengths
  int slice_;
};

}  // namespace helical
