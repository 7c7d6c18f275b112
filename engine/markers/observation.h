#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>

#include "engine/base/ids.h"
#include "engine/base/time.h"

namespace helical {

/// One coloured region of an image: a marker, or something that looks like one.
struct Centroid {
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();           ///< centre of gravity
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Identity();  ///< px^2, for a ball that is fully visible
  double area_px = 0.0;                                      ///< pixels in the region
  double radius_px = 0.0;                                    ///< of the disc of that area
  int colour = 0;  ///< which of the options' colours: 0 the first, then `other_colours` in order
};

/// More regions than this in one frame are clutter: the largest are kept and `truncated` is set.
inline constexpr int kMaxCentroids = 32;

/// Everything one camera saw at one time. Fixed size: it travels through queues without allocation.
struct Observation {
  CameraId camera;
  std::uint64_t sequence = 0;  ///< of the frame
  TimeNs exposure = 0;         ///< mid-exposure
  TimeNs arrival = 0;          ///< of the frame at this machine
  TimeNs extraction = 0;       ///< processor time spent on extraction; 0 if there was no image
  int count = 0;
  bool truncated = false;
  std::array<Centroid, kMaxCentroids> centroids{};
};

/// Where observations come from: an extractor behind a camera, a recording, another computer, or the
/// simulator without images. Everything after it is the same for all of them. One thread calls `poll` and
/// `wait`.
class ObservationSource {
 public:
  virtual ~ObservationSource() = default;

  virtual CameraId camera() const = 0;

  /// The oldest observation that has arrived by now and was not yet polled; false if there is none. Never
  /// blocks.
  virtual bool poll(Observation& observation) = 0;

  /// Blocks until an observation can be polled or the clock passes `deadline`.
  virtual void wait(TimeNs deadline) = 0;
};

}  // namespace helical
