#pragma once

#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "engine/geometry/camera_estimate.h"
#include "engine/geometry/camera_model.h"
#include "engine/helicopter/marker_layout.h"
#include "engine/markers/observation.h"
#include "engine/tracking/track.h"
#include "engine/tracking/tracker_options.h"

namespace helical {

/// Helicopter pose and velocity from what every usable camera sees. One thread; allocates nothing after
/// construction.
class Tracker {
 public:
  virtual ~Tracker() = default;

  /// Takes in what one camera saw. Cameras that are not `usable` are not looked at.
  virtual void update(const Observation& observation, std::span<const CameraEstimate> cameras,
                      std::span<const bool> usable, bool airborne) = 0;

  /// Balls and focal lengths were found to be these; cameras in their order. Where the helicopter is jumps by so
  /// little that the tracker follows.
  virtual void correct(const MarkerLayout& markers, std::span<const CameraModel> cameras) = 0;

  /// Goes on from where another tracker of the same kind and rig is.
  virtual void adopt(const Tracker& other) = 0;

  /// Whether a pose was ever found.
  virtual bool acquired() const = 0;
  /// Exposure time of the last observation that was used.
  virtual TimeNs lastUpdate() const = 0;
  /// State and covariance at `time`, by the tracker's model of motion.
  virtual TrackedState predict(TimeNs time, bool airborne) const = 0;
  /// What was made of the newest observation of a camera.
  virtual const CameraTrack& track(CameraId camera) const = 0;
};

/// "helical", the default: `PixelFilter`; "paper": `LatestImagesTracker`.
std::span<const std::string_view> trackerNames();

/// Throws Error(kInput) listing the names for an unknown one.
std::unique_ptr<Tracker> makeTracker(std::string_view name, const TrackerOptions& options,
                                     const MarkerLayout& markers, std::vector<CameraModel> cameras,
                                     double standing_height);

}  // namespace helical
