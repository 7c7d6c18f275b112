#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "engine/pipeline/snapshot.h"
#include "engine/simulator/verdict.h"

namespace helical {

/// Root mean square of a stream.
class RunningRms {
 public:
  void add(double value) {
    sum_ += value * value;
    ++count_;
  }
  std::uint64_t count() const { return count_; }
  double value() const;

 private:
  double sum_ = 0.0;
  std::uint64_t count_ = 0;
};

/// How well a simulated flight was tracked and flown, from its ticks in order. Tracking errors count while it
/// is in the air with a pose; control errors, true position against set-point, over the hover: from 2 s after
/// it reached the first waypoint until the landing begins. One thread.
class FlightScore {
 public:
  void add(const EngineSnapshot& tick);

  const RunningRms& trackedPosition() const { return tracked_position_; }        ///< m
  const RunningRms& trackedOrientation() const { return tracked_orientation_; }  ///< rad
  double lostSeconds() const { return lost_s_; }  ///< without a pose while the rotors turned
  const RunningRms& hoverHorizontal() const { return hover_horizontal_; }  ///< m
  const RunningRms& hoverHeight() const { return hover_height_; }          ///< m
  const RunningRms& hoverYaw() const { return hover_yaw_; }                ///< rad
  /// Mean normalised estimation error squared of the pose (6 degrees of freedom), and of its parts: x and y
  /// (2), z (1), roll and pitch (2), yaw (1). 0 without samples.
  double nees() const { return mean(nees_[0]); }
  double neesPart(int part) const { return mean(nees_[static_cast<std::size_t>(part) + 1]); }
  std::uint64_t neesSamples() const { return nees_samples_; }
  /// Share of a camera's markers that were used while the rotors turned, 0..1.
  double selectedShare(CameraId camera) const;
  /// When a camera that is calibrated in flight first was within 1 cm and 0.5 degrees [s]; negative if never.
  double convergedAfter(CameraId camera) const {
    return converged_s_[static_cast<std::size_t>(camera.index())];
  }
  std::uint32_t failsafes() const { return failsafes_; }
  /// Pre-arm checks that still failed at the end of a flight that was never armed; 0 for any other.
  std::uint32_t unarmedBecause() const { return armed_ ? 0 : failing_checks_; }
  bool hasFlown() const { return has_flown_; }  ///< as the flight itself saw it

 private:
  double mean(double sum) const { return nees_samples_ > 0 ? sum / static_cast<double>(nees_samples_) : 0.0; }
  void addTracking(const EngineSnapshot& tick);
  void addControl(const EngineSnapshot& tick);
  void addCalibration(const EngineSnapshot& tick);

  RunningRms tracked_position_, tracked_orientation_, hover_horizontal_, hover_height_, hover_yaw_;
  std::array<double, 5> nees_{};
  std::uint64_t nees_samples_ = 0;
  double lost_s_ = 0.0;
  TimeNs last_time_ = 0;
  TimeNs hover_since_ = -1;
  std::uint32_t failsafes_ = 0;
  std::uint32_t failing_checks_ = 0;
  bool armed_ = false;
  bool has_flown_ = false;
  std::array<std::uint64_t, kMaxCameras> selected_{};
  std::array<std::uint64_t, kMaxCameras> shown_{};
  std::array<TimeNs, kMaxCameras> last_exposure_{};
  std::array<double, kMaxCameras> converged_s_ = [] {
    std::array<double, kMaxCameras> never{};
    never.fill(-1.0);
    return never;
  }();
};

/// How far a camera's estimated place is from its true one.
struct CameraError {
  double position = 0.0;     ///< of the centre [m]
  double orientation = 0.0;  ///< rad
};
CameraError cameraError(const RigidTransform& estimated_camera_from_world,
                        const RigidTransform& true_camera_from_world);

/// Normalised error squared of a camera's estimate: 6 on average where the covariance is true.
double calibrationNees(const CameraEstimate& estimate, const RigidTransform& true_camera_from_world);

/// "landed", "crashed", "failsafe-landed" or "aborted", as `helical fly` reports it.
std::string outcomeOf(const Verdict& verdict, std::uint32_t failsafes);
/// The same of a flight's last state; without the truth as the flight itself saw it: rotors off after it was airborne.
std::string outcomeOf(const EngineSnapshot& last, const FlightScore& score);

/// The reasons of the checks in a bit set.
std::vector<std::string> checkReasons(std::uint32_t failing_checks);

/// Names of the failsafes in a bit set.
std::vector<std::string> failsafeNames(std::uint32_t failsafes);

}  // namespace helical
