#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/pipeline/snapshot.h"

namespace helical {

/// One value per control tick of the whole flight.
enum class FlightColumn {
  kX,
  kY,
  kZ,
  kYaw,  ///< degrees, unwrapped
  kReferenceX,
  kReferenceY,
  kReferenceZ,
  kReferenceYaw,      ///< degrees
  kPositionError,     ///< m, where the truth is known
  kOrientationError,  ///< degrees, where the truth is known
  kPositionSigma,     ///< m
  kUpperRotor,
  kLowerRotor,
  kRoll,
  kPitch,
  kServerLatency,   ///< ms, 99 %
  kCommandLatency,  ///< ms, 99 %
  kGust,            ///< 1 while one ordered by the operator blows
  kCount
};

/// One value per control tick and camera.
enum class CameraColumn {
  kPositionError,     ///< m, of a calibrating camera whose true place is known
  kOrientationError,  ///< degrees
  kPositionSigma,     ///< m, of a calibrating camera
  kOrientationSigma,  ///< degrees
  kPositionBound,     ///< m: no estimate can be better
  kOrientationBound,  ///< degrees
  kEffective,         ///< effective sample size
  kResidual,          ///< px
  kSelected,          ///< bits of the markers used for the pose
  kCovered,           ///< 1 while hidden or behind a board
  kTampered,          ///< 1 while the operator loses its frames or makes them noisy
  kLatency,           ///< ms, of a frame that is new at this tick
  kKnocks,            ///< so far
  kStatus,            ///< a CameraStatus
  kByMisfit,          ///< 1: what follows is no De [m] but a misfit [standard deviations]
  kLabelling1,        ///< of the labelling that its calibration took
  kLabelling2,        ///< of the others that it weighed up, the best first
  kLabelling3,
  kLabelling4,
  kLabelling5,
  kLabelling6,
  kCount
};

/// What the plots show: the last 20 minutes at 60 Hz, one row per control tick. Missing values are NaN. All
/// memory is taken at once, so that an hour of supervision costs no more than a minute.
class TickHistory {
 public:
  static constexpr std::int64_t kCapacity = 72'000;

  explicit TickHistory(int cameras);

  /// A tick from before the last one begins anew: a recording that was wound back.
  void add(const EngineSnapshot& tick);

  /// Rows are numbered from the first tick ever; those before `first` are forgotten.
  std::int64_t first() const { return end_ > kCapacity ? end_ - kCapacity : 0; }
  std::int64_t end() const { return end_; }
  /// The first row at or after `time` [s].
  std::int64_t rowAt(double time) const;

  double time(std::int64_t row) const { return times_[slot(row)]; }
  double value(std::int64_t row, int column) const {
    return values_[static_cast<std::size_t>(column) * kCapacity + slot(row)];
  }

  int cameras() const { return cameras_; }
  static int column(FlightColumn column) { return static_cast<int>(column); }
  int column(int camera, CameraColumn column) const {
    return static_cast<int>(FlightColumn::kCount) + camera * static_cast<int>(CameraColumn::kCount) +
           static_cast<int>(column);
  }

 private:
  static std::size_t slot(std::int64_t row) { return static_cast<std::size_t>(row % kCapacity); }
  void set(FlightColumn which, double value);
  void set(int camera, CameraColumn which, double value);
  void addFlight(const EngineSnapshot& tick);
  void addCamera(const EngineSnapshot& tick, int camera);

  int cameras_;
  std::int64_t end_ = 0;
  double yaw_deg_ = 0.0;  ///< unwrapped
  std::array<std::uint64_t, kMaxCameras> frames_{};
  std::vector<double> times_;
  std::vector<float> values_;  ///< column by column
};

}  // namespace helical
