#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "engine/calibration/cold_start.h"
#include "engine/calibration/knock_detector.h"
#include "engine/calibration/live_bound.h"
#include "engine/calibration/refinement_report.h"
#include "engine/calibration/rig_refinement.h"
#include "engine/calibration/step_detector.h"
#include "engine/config/rig_config.h"
#include "engine/pipeline/calibration_order.h"
#include "engine/pipeline/camera_calibration.h"
#include "engine/tracking/tracker.h"

namespace helical {

/// Which cameras the helicopter is flown on, and how the others get there: keeps every camera's estimate,
/// teaches those whose pose is not known yet, and takes out those that were knocked, whether their pose was
/// given or learnt, to teach them anew from where they stood. Of two that disagree nobody can tell which one
/// was moved, and none is named; but flying on with both crashes, so that the one that jumped away from the
/// pose predicted from before is set aside until it agrees again or the operator decides. Knocks too small to
/// throw a ball out of its gate are found by StepDetector where three cameras are in control.
///
/// Who teaches whom has no circles. Cameras with a given pose have rank 0, those whose pose has to be found
/// rank 1, and a knocked camera gets a rank above all others. A camera learns from a pose that cameras of
/// lower rank alone have seen, two at least: a camera that taught itself would confirm its own error, and two
/// that taught each other would confirm each other's. One thread; allocates nothing after construction.
class ControlSet {
 public:
  /// Throws Error(kInput) for an unknown method of calibration or kind of tracker.
  explicit ControlSet(const RigConfig& rig);

  /// The operator hides a camera: nothing that it shows is used.
  void hide(CameraId camera, bool hidden);
  bool hidden(CameraId camera) const { return hidden_[indexOf(camera)]; }

  std::span<const CameraEstimate> estimates() const { return {estimates_.data(), cameras_}; }
  /// Whom the tracker looks at: calibrated and not hidden.
  std::span<const bool> usable() const { return {usable_.data(), cameras_}; }

  /// After the tracker has taken in this observation: judges its camera, teaches it, or has it teach others.
  void learn(const Observation& observation, const Tracker& tracker, bool airborne);

  /// What the operator decided. Null, or why it cannot be done: a literal.
  const char* obey(const CalibrationOrder& order);
  bool frozen(CameraId camera) const { return frozen_[indexOf(camera)]; }

  /// Puts another calibration in the place of a camera's own and hands that back. A camera that learns leaves
  /// the control set until the new one is admitted; any other uses it once it is knocked. Allocates and frees
  /// nothing.
  void swapCalibration(CameraId camera, std::unique_ptr<CameraCalibration>& calibration);
  /// Null for a camera that does not learn.
  const CameraCalibration* calibration(CameraId camera) const;
  /// By which a camera's pose is or was found in this flight: a literal; null if it was given.
  const char* method(CameraId camera) const;
  /// While too few cameras are known to fly: what the operator has to do; a literal, else null.
  const char* instruction() const;
  std::optional<CalibrationBound> bound(CameraId camera) const { return bounds_[indexOf(camera)].bound(); }
  /// Balls and lenses: as the rig has them, or as a refinement found them.
  const MarkerLayout& markers() const { return markers_; }
  std::span<const CameraModel> models() const { return models_; }
  double focalScale(CameraId camera) const { return refinement_->focalScale(camera); }  ///< over the rig's
  /// Whether they have changed since this was asked: those who look by them have to follow.
  bool takeCorrection();
  const RefinementReport& refinement() const { return report_; }
  /// Of this camera and the one other that saw the helicopter then one was moved, and it was set aside. Ends when it
  /// has a place again, is to calibrate anew, or is hidden.
  bool camerasDisagree() const;
  /// Where each camera stands, in control or as it was set aside; null where nobody vouches for a place.
  std::array<const CameraEstimate*, kMaxCameras> places() const;
  /// It does stand where it stood: if it was set aside it flies again, and what it showed of late counts no
  /// more.
  void standsAsBefore(CameraId camera);
  /// How often this camera was found knocked.
  int knocksFound(CameraId camera) const { return knocks_found_[indexOf(camera)]; }

 private:
  static std::size_t indexOf(CameraId camera) { return static_cast<std::size_t>(camera.index()); }
  void refreshUsable();
  /// Its share of finding cameras when fewer than two are known.
  void startCold(const Observation& observation, bool airborne);
  /// It stands there, and nobody in this flight told it so.
  void place(std::size_t camera, const CameraEstimate& estimate);
  /// How many cameras bear witness that this one was knocked; 0: it was not.
  int witnessesOfKnock(const Observation& observation, const Tracker& tracker);
  /// Looks for small knocks, of this camera or of another one. `flown`: the pose at the exposure, in the air.
  void watchSteps(const Observation& observation, const Tracker& tracker, const RigidTransform& flown);
  void takeOut(std::size_t camera, int witnesses, const Tracker& tracker);
  /// Ranks without gaps, and the teachers with them.
  void closeRanks();
  bool somebodyLearnsAt(int rank) const;
  void teachOthers(const Observation& observation, bool airborne);
  void teach(const Observation& observation, const Tracker& tracker, bool airborne);
  void addToBound(const Observation& observation, const Tracker& tracker,
                  const RigidTransform& world_from_body);

  /// The balls in the newest frame, named by the tracker for a camera in control, by its calibrator for a
  /// learning one. `outside_gate`: those, too, that do not lie where the pose says.
  NamedBalls namedBalls(const Observation& observation, const Tracker& tracker, bool outside_gate) const;
  /// Has the refinement see the balls that this camera and the tracker agree on.
  void showToRefinement(const Observation& observation, const Tracker& tracker, const RigidTransform& flown);
  const char* startRefinement();
  void takeRefinement(const Eigen::Vector3d& helicopter_in_world);
  /// Its pose is told by others from here on.
  void leaveRefinement(std::size_t camera);
  void correctFromRefinement();
  void learnAnew(std::size_t camera);
  void setFocalScale(std::size_t camera, double scale);
  /// What it saw so far tells refinements nothing.
  void forgetViews(std::size_t camera);
  void endRefinement(RefinementOutcome outcome);

  std::size_t cameras_;
  std::vector<CameraModel> models_, rig_models_;
  MarkerLayout markers_, rig_markers_;
  bool corrected_ = false;          ///< by a refinement, at any time
  bool fresh_correction_ = false;   ///< that the tracker does not know of yet
  RefinementReport report_;
  bool learn_from_own_pose_;
  std::array<CameraEstimate, kMaxCameras> estimates_;
  std::array<bool, kMaxCameras> hidden_{};
  std::array<bool, kMaxCameras> usable_{};
  std::array<bool, kMaxCameras> learning_{};
  std::array<bool, kMaxCameras> frozen_{};
  std::array<std::optional<CameraEstimate>, kMaxCameras> given_;  ///< by the rig file
  std::array<int, kMaxCameras> rank_{};
  std::array<KnockDetector, kMaxCameras> detectors_;
  StepDetector steps_;
  std::array<int, kMaxCameras> knocks_found_{};
  std::array<std::optional<CameraEstimate>, kMaxCameras> set_aside_;  ///< where it stood when two disagreed
  std::array<std::unique_ptr<CameraCalibration>, kMaxCameras> calibrations_;
  std::array<LiveBound, kMaxCameras> bounds_;
  std::unique_ptr<ColdStart> cold_start_;                ///< if fewer than two cameras were given
  std::array<bool, kMaxCameras> found_by_cold_start_{};  ///< or are to be
  std::unique_ptr<RigRefinement> refinement_;
  std::array<bool, kMaxCameras> refining_{};  ///< takes part, and nothing else happened to it since
  std::array<bool, kMaxCameras>
      refined_{};  ///< the refinement found it, and it learns on from there or stands
  std::vector<std::unique_ptr<Tracker>> teachers_;  ///< [r] sees with cameras of rank below r alone
};

}  // namespace helical
