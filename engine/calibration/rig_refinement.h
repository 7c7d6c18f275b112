#pragma once

#include <array>
#include <bitset>
#include <span>
#include <vector>

#include "engine/calibration/moment_maker.h"
#include "engine/calibration/rig_bundle.h"
#include "engine/calibration/thinned_store.h"

namespace helical {

struct RigRefinementOptions {
  double spacing_s = 0.1;        ///< between the moments that are kept, at least
  int moments = 256;             ///< kept; the most redundant makes room
  int fewest_moments = 24;       ///< before anything is solved
  int fewest_of_camera = 12;     ///< moments in which a camera must have seen the helicopter
  double good_inliers = 0.7;     ///< share of a camera's balls that must fit
  double good_median = 3.0;      ///< standard deviations that the median residual may have; 1.2 is expected
  double lasting_sigma_px = 0.08, lasting_time_s = 1.0;  ///< see LastingOffsets
};

/// Throws Error(kInput) naming the offending key.
void validate(const RigRefinementOptions& options);

/// All cameras of a rig solved for together, on demand, from what they saw of the helicopter in this flight: each
/// learns for itself otherwise, which is quick and loses a tenth of what the frames hold. Looks on all the time and
/// keeps moments spread over the helicopter's poses; solves in slices of bounded work, so that no image waits for
/// it. One thread; allocates at construction only.
class RigRefinement {
 public:
  /// What is known of one camera when it starts.
  struct Part {
    CameraEstimate estimate;
    bool used = false;
    bool holds = false;  ///< its pose is known up to its covariance, and with it the world
  };

  RigRefinement(const std::vector<CameraModel>& cameras, const MarkerLayout& markers,
                const RigRefinementOptions& options = {});

  /// The balls that a camera saw, and about where the helicopter was.
  void see(CameraId camera, const NamedBalls& balls, const RigidTransform& world_from_body);
  /// It was moved: what it saw before counts no more.
  void forget(CameraId camera);

  /// Null, or why it cannot be done: a literal.
  const char* start(std::span<const Part> cameras);
  void stop() { bundle_.stop(); }
  bool running() const { return bundle_.running(); }

  /// One observation's share of the work. True when it ended just now.
  bool work();

  /// Of a run that ended: where it found this camera. Status kCalibrated; kUncalibrated for one that it could not
  /// find, or that held the world exactly.
  CameraEstimate answer(CameraId camera) const;

 private:
  void keep(TimeNs now, const RigidTransform& world_from_body);

  RigRefinementOptions options_;
  std::size_t cameras_;
  MomentMaker maker_;
  ThinnedStore<RigMoment> store_;
  TimeNs last_kept_ = 0;
  RigMoment moment_;
  std::vector<RigMoment> solved_;  ///< what the bundle works on
  std::size_t solved_count_ = 0;
  RigBundle bundle_;
  std::vector<BundleCamera> start_;
  int slice_;
};

}  // namespace helical
