#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <string_view>

#include "engine/calibration/admission.h"
#include "engine/calibration/calibrator_factory.h"
#include "engine/config/rig_config.h"
#include "engine/correspondence/label_keeper.h"
#include "engine/correspondence/labelling_search.h"
#include "engine/tracking/track.h"

namespace helical {

/// One un-calibrated camera's way into the control set (the paper's section III): its centroids get names by
/// nested polygons and keep them from frame to frame, unless its calibrator names them for itself; that
/// learns from every frame that the other cameras see too, and the one admission rule says when it may be
/// flown on. A labelling that does not explain the frames is given up and sought again. Centroids are
/// followed without names while labellings are sought, a few with every image, so that none waits for it. One
/// thread; allocates at construction only.
class CameraCalibration {
 public:
  /// `guess`: a first guess of camera_from_world; without one the method is "joint", which needs none, whatever
  /// is asked for. Throws Error(kInput) for an unknown method.
  CameraCalibration(std::string_view method, const CameraModel& camera, const MarkerLayout& markers,
                    const std::optional<RigidTransform>& guess, std::uint64_t seed,
                    const CalibratorOptions& options = {});

  /// Forgets everything and starts from another guess. `status` stands until the camera is admitted.
  void restart(const RigidTransform& guess, CameraStatus status);

  /// The operator vouches for what it knows now: however uncertain that is, the camera comes in, and leaves only
  /// when it disagrees. False if it does not know its place, or disagrees already.
  bool accept();

  /// Balls and focal lengths were found to be these. A search for names begins anew.
  void correct(const CameraModel& camera, const MarkerLayout& markers);

  /// Learns on from what others found for it, as admitted; false, and nothing changes, if its method cannot.
  bool goOnFrom(const CameraEstimate& estimate);

  /// One frame, and the helicopter at its exposure as the other cameras have it.
  void step(const Observation& observation, const TrackedState& helicopter);

  /// Pose, covariance and, by the admission rule, status.
  CameraEstimate estimate() const;
  const ExtrinsicCalibrator& calibrator() const { return *calibrator_; }
  /// Those of the last search, or of the one that goes on.
  TriedLabellings labellings() const {
    return calibrator_->namesCentroids() ? calibrator_->labellings() : labellings_;
  }

 private:
  bool isAdmitted() const { return admission_.status == CameraStatus::kCalibrated; }
  /// Out of the control set, until the rule has seen enough anew.
  void expelAs(CameraStatus status);
  void startSeeking(const Observation& observation, const TrackedState& helicopter);
  void seekLabels();
  /// The method's centroids, named for it.
  std::span<const LabelledPixel> keepLabels(const Observation& observation, const TrackedState& helicopter);
  void judge(const CalibrationFrame& frame, const Eigen::Vector3d& helicopter_in_world);

  CameraModel camera_;
  MarkerLayout markers_;
  bool has_guess_;
  RigidTransform guess_;
  std::unique_ptr<ExtrinsicCalibrator> calibrator_;
  // For methods that do not name centroids themselves:
  LabelKeeper tracks_;    ///< centroids, numbered as they stood when the search began
  LabellingWalk search_;  ///< for the marker that each of them is
  Names track_of_marker_;
  bool named_ = false;
  TriedLabellings labellings_;
  std::array<LabelledPixel, kMaxMarkers> pixels_;
  AdmissionOptions admission_options_;
  AdmissionMemory admission_;
  bool accepted_ = false;
  TimeNs doubtful_since_ = -1;
};

/// A camera's calibration anew, from the rig file's guess.
std::unique_ptr<CameraCalibration> newCalibration(const RigConfig& rig, CameraId camera, std::string_view method,
                                                  std::uint64_t seed);

}  // namespace helical
