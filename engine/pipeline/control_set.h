#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "engine/calibration/knock_detector.h"
#include "engine/calibration/live_bound.h"
#include "engine/config/rig_config.h"
#include "engine/pipeline/camera_calibration.h"
#include "engine/tracking/tracker.h"

namespace helical {

/// Which cameras the helicopter is flown on, and how the others get there: keeps every camera's estimate,
/// teaches those whose pose is not known yet, and takes out those that were knocked, whether their pose was
/// given or learnt, to teach them anew from where they stood. The one that jumped is taken out, also
/// of two: flying on with both of them crashes, and the pose predicted from before tells which one it was.
///
/// Who teaches whom has no circles. Cameras with a given pose have rank 0, those with a first guess rank 1,
/// and a knocked camera gets a rank above all others. A camera learns from a pose that cameras of lower rank
/// alone have seen, two at least: a camera that taught itself would confirm its own error, and two that
/// taught each other would confirm each other's. One thread; allocates nothing after construction.
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

  /// Puts another calibration in the place of a camera's own and hands that back. A camera that learns leaves
  /// the control set until the new one is admitted; any other uses it once it is knocked. For cameras with a
  /// pose or a guess; allocates and frees nothing.
  void swapCalibration(CameraId camera, std::unique_ptr<CameraCalibration>& calibration);
  /// Null for a camera that does not learn.
  const CameraCalibration* calibration(CameraId camera) const;
  std::optional<CalibrationBound> bound(CameraId camera) const { return bounds_[indexOf(camera)].bound(); }
  /// How often this camera was found knocked.
  int knocksFound(CameraId camera) const { return knocks_found_[indexOf(camera)]; }

 private:
  static std::size_t indexOf(CameraId camera) { return static_cast<std::size_t>(camera.index()); }
  void refreshUsable();
  bool isKnocked(const Observation& observation, const Tracker& tracker);
  void takeOut(std::size_t camera, const Tracker& tracker);
  /// Ranks without gaps, and the teachers with them.
  void closeRanks();
  bool somebodyLearnsAt(int rank) const;
  void teachOthers(const Observation& observation, bool airborne);
  void teach(const Observation& observation, const Tracker& tracker, bool airborne);
  void addToBound(const Observation& observation, const Tracker& tracker,
                  const RigidTransform& world_from_body);

  std::size_t cameras_;
  std::vector<CameraModel> models_;
  MarkerLayout markers_;
  bool learn_from_own_pose_;
  std::array<CameraEstimate, kMaxCameras> estimates_;
  std::array<bool, kMaxCameras> hidden_{};
  std::array<bool, kMaxCameras> usable_{};
  std::array<bool, kMaxCameras> learning_{};
  std::array<int, kMaxCameras> rank_{};
  std::array<KnockDetector, kMaxCameras> detectors_;
  std::array<int, kMaxCameras> knocks_found_{};
  std::array<std::unique_ptr<CameraCalibration>, kMaxCameras> calibrations_;  ///< null: nothing to start from
  std::array<LiveBound, kMaxCameras> bounds_;
  std::vector<std::unique_ptr<Tracker>> teachers_;  ///< [r] sees with cameras of rank below r alone
};

}  // namespace helical
