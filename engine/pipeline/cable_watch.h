#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/geometry/camera_estimate.h"
#include "engine/geometry/camera_model.h"
#include "engine/helicopter/marker_layout.h"
#include "engine/markers/observation.h"
#include "engine/tracking/acquisition.h"
#include "engine/tracking/tracker.h"

namespace helical {

/// What cameras that disagree with the pose have to say once they are asked together. Two whose cables were
/// changed each show what the other one should: with their frames changed back, one pose explains all
/// cameras, three times in a row, at least twice as well as without and with those of any other two changed.
/// A camera that was set aside because two disagreed comes back when one pose explains it and the others
/// again, ten times in a row. A knocked camera does neither: no pose explains it from where it stood. One
/// attempt to find such a pose with each frame of a camera that disagrees, fewer when that goes on for
/// seconds. One thread; allocates nothing after construction.
class CableWatch {
 public:
  CableWatch(const MarkerLayout& markers, std::vector<CameraModel> cameras, double standing_height);

  /// See Tracker.
  void correct(const MarkerLayout& markers, std::span<const CameraModel> cameras);

  /// The camera at the other end of a stream's cable; at first, the one that the stream is named after.
  CameraId cameraOf(CameraId stream) const { return camera_of_[indexOf(stream)]; }
  /// How often two were found changed.
  std::uint32_t changes() const { return changes_; }

  enum class Finding : std::uint8_t {
    kNothing,
    kAgreesAgain,  ///< this camera, which was set aside, and the others
    kChanged,      ///< the cables of this camera and `other`: `cameraOf` is up to date
  };
  struct Verdict {
    Finding finding = Finding::kNothing;
    CameraId camera, other;
  };
  /// Where a camera stands, as far as somebody vouches for that; null: nobody does.
  using Places = std::array<const CameraEstimate*, kMaxCameras>;

  /// After the tracker has taken in this frame, of the camera that `cameraOf` says. Those in `places` that
  /// are not `usable` were set aside.
  Verdict add(const Observation& observation, const Places& places, std::span<const bool> usable,
              const Tracker& tracker, bool airborne);

 private:
  static std::size_t indexOf(CameraId camera) { return static_cast<std::size_t>(camera.index()); }
  /// What is known when a frame comes in.
  struct Moment {
    TimeNs now;
    const Places& places;
    std::span<const bool> usable;
    const Tracker& tracker;
    bool airborne;
  };
  void noteWhetherOdd(const Observation& observation, const Moment& moment);
  bool isOdd(std::size_t camera, TimeNs now) const;
  bool isPair(std::size_t a, std::size_t b, const Moment& moment) const;
  /// The next two of which one disagrees.
  void nextPair(const Moment& moment);
  /// How well one pose explains the cameras in control and these two, with the frames of these two changed or
  /// as they come [px]; infinite: none does.
  double misfit(std::size_t a, std::size_t b, bool changed, const Moment& moment);
  Verdict askAlone(std::size_t camera, const Moment& moment);
  Verdict askPair(const Moment& moment);
  bool othersAreWorse(std::size_t a, std::size_t b, const Moment& moment) const;
  void forgetPairs();
  bool showsBallsOf(const RigidTransform& world_from_body, std::size_t camera, const CameraEstimate& place,
                    const Observation& shown) const;

  MarkerLayout markers_;
  std::vector<CameraModel> cameras_;
  double standing_height_;
  Acquisition acquisition_;
  std::array<CameraId, kMaxCameras> camera_of_{};
  std::array<Observation, kMaxCameras> newest_{};
  std::array<int, kMaxCameras> odd_frames_{};  ///< in a row, that disagree
  std::array<int, kMaxCameras> tries_{};       ///< since it began to disagree
  std::array<int, kMaxCameras> good_tries_{};  ///< in a row, of those set aside
  struct Pair {
    int good = 0;         ///< tries in a row
    double misfit = 0.0;  ///< of the last one [px]; 0: not tried yet
  };
  std::array<std::array<Pair, kMaxCameras>, kMaxCameras> pairs_{};  ///< [a][b], a < b
  std::size_t a_ = 0, b_ = 0;                                       ///< those of the last try
  std::uint32_t changes_ = 0;
};

}  // namespace helical
