#pragma once

#include <memory>
#include <span>
#include <vector>

#include "engine/calibration/body_view.h"
#include "engine/calibration/moment_maker.h"
#include "engine/calibration/rig_bundle.h"
#include "engine/markers/observation.h"

namespace helical {

struct ColdStartOptions {
  double stand_s = 1.0;           ///< the helicopter stands as long as this before it is believed to stand
  double spacing_s = 0.1;         ///< between the moments that are solved over, at least
  double spacing_m = 0.03;        ///< and how far the helicopter has moved between them
  int first_moments = 24;         ///< before a first solution is tried
  double good_inliers = 0.7;      ///< share of a camera's balls that must fit
  double good_median = 3.0;       ///< standard deviations that the median residual may have; 1.2 is expected
  double good_uncertainty_m = 0.008;  ///< at the helicopter's place, as AdmissionOptions has it
  double lasting_sigma_px = 0.08, lasting_time_s = 1.0;  ///< see LastingOffsets
};

/// Calibrates a rig of which no camera is known, or one: the known places of the balls on the helicopter set the
/// scale, the helicopter standing on the landing pad sets the world (or the known camera does), and the helicopter
/// waved through the space by hand links the cameras. Each camera finds the helicopter for itself (BodyView); what
/// they see at the same moments is solved for all of them at once (RigBundle), anew as more comes. In slices of
/// bounded work; allocates at construction only. One thread.
class ColdStart {
 public:
  /// `given`: what is known of each camera; status kCalibrated for known ones. `standing_height` [m] of the body's
  /// origin on the pad.
  ColdStart(const std::vector<CameraModel>& cameras, const MarkerLayout& markers, double standing_height,
            std::span<const CameraEstimate> given, const ColdStartOptions& options = {});

  void step(const Observation& observation);

  /// True once after each new answer.
  bool takeAnswer();
  /// Cameras that are well enough known have status kCalibrated.
  std::span<const CameraEstimate> answer() const { return answer_; }

  /// What the operator has to do now; a literal.
  const char* instruction() const;

 private:
  static constexpr int kMaxMoments = 96, kMaxPadMoments = 8, kMaxWaiting = 16;
  static constexpr int kStored = kMaxMoments + kMaxPadMoments;
  struct Seen {
    std::bitset<kMaxCameras> has;
    std::array<RigidTransform, kMaxCameras> camera_from_body;
  };
  struct Still {
    bool known = false;
    std::array<Eigen::Vector2d, kMaxMarkers> pixels;  ///< running means
    double frames = 0.0;
    TimeNs since = 0, last = 0;
  };
  enum class Stage { kStand, kWave, kSolved };

  void watchStanding(std::size_t camera, TimeNs now);
  void collect(TimeNs now);
  bool keep(TimeNs time, bool on_pad);
  void thin();
  void drop(std::size_t camera);
  void startSolving(TimeNs now);
  bool placeCameras();
  bool placeMoments();
  void judge();
  Eigen::Vector3d whereSeen(std::size_t camera) const;

  std::vector<CameraModel> models_;
  MarkerLayout markers_;
  RigidTransform on_pad_;
  ColdStartOptions options_;
  std::vector<std::unique_ptr<BodyView>> views_;
  MomentMaker maker_;
  std::vector<RigMoment> moments_;  ///< those on the pad first
  std::vector<Seen> seen_;
  int pad_count_ = 0, count_ = 0;  ///< on the pad; all
  RigBundle bundle_;
  std::vector<BundleCamera> start_;
  std::vector<CameraEstimate> given_, answer_;
  std::vector<Still> still_;
  bool world_is_given_ = false;
  Stage stage_ = Stage::kStand;
  RigidTransform last_seen_;  ///< camera_from_body of `last_camera_` at the last moment kept
  int last_camera_ = -1;
  TimeNs last_moment_ = 0, last_solved_ = 0;
  double spacing_m_;
  int since_solved_ = 0;
  bool fresh_answer_ = false;
  int slice_;
};

}  // namespace helical
