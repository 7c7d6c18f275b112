#pragma once

#include <array>
#include <deque>
#include <mutex>
#include <optional>
#include <vector>

#include "engine/base/random.h"
#include "engine/base/time.h"
#include "engine/helicopter/dynamics.h"
#include "engine/simulator/carried_path.h"
#include "engine/simulator/simulation_options.h"
#include "engine/simulator/verdict.h"

namespace helical {

/// The helicopter at one time, as it really is.
struct WorldSample {
  HelicopterState state;
  double upper_rotor_angle = 0.0;  ///< rad
  double lower_rotor_angle = 0.0;  ///< rad
};

/// The simulated field: one helicopter with drawn parameters, gusts, and the stick positions on their way to
/// it, at 1 kHz. Until `field_empty_s` the field is empty; then the helicopter stands on the pad. Any thread
/// (one lock); samples can be taken up to 0.25 s back.
class World {
 public:
  /// `carried_s`: for so long somebody carries it about once it is there (0: it is put on the pad at once).
  World(const SimulationOptions& options, const HelicopterParameters& nominal, double carried_s = 0.0);

  /// Simulates up to `time`; does nothing if that is past.
  void advanceTo(TimeNs time);

  /// The helicopter at `time`, interpolated; nothing while the field is empty. `time` is not later than the
  /// last advance.
  std::optional<WorldSample> at(TimeNs time) const;

  /// Keeps the field empty beyond `field_empty_s` until as many releases have come: a camera with images
  /// first needs its background, however slow the machine is.
  void holdEmpty();
  void releaseEmpty();

  /// Somebody carries the helicopter off the field for so long, from now, for cameras that take a new
  /// background; then it stands where it stood.
  void clearField(double duration_s);

  /// Sticks that take effect at `when`.
  void command(const StickDemand& demand, TimeNs when);

  /// A gust of `wind` [m/s, world] now, which swells and dies within `duration_s`; a new one takes the place
  /// of the last.
  void gust(const Eigen::Vector3d& wind, double duration_s);
  /// Somebody knocks a camera now: it turns about a random axis and shifts in a random direction.
  void knock(CameraId camera, double angle, double distance);
  /// For worlds that follow a recorded one: the helicopter is on the field, and was like this at `time`, within
  /// a few milliseconds of the last advance; rotors, bar and air are not known and go on as they are. Nothing
  /// happens while somebody carries it.
  void setRight(const HelicopterState& state, TimeNs time);
  /// Likewise: a camera that would be at `camera_from_world` truly is at `true_camera_from_world`.
  void setRight(CameraId camera, const RigidTransform& camera_from_world,
                const RigidTransform& true_camera_from_world);
  /// Where a camera is that would be at `camera_from_world` had nobody knocked it by `knock`.
  RigidTransform knocked(CameraId camera, const RigidTransform& camera_from_world) const;

  Verdict verdict() const;
  const HelicopterParameters& parameters() const { return dynamics_.parameters(); }

 private:
  struct Knock {
    CameraId camera;
    double angle;     ///< rad
    double distance;  ///< m
    Random random;
  };
  struct Command {
    TimeNs when;
    StickDemand demand;
  };
  void stepOnce();
  /// In somebody's hands now.
  bool isCarried() const;
  void blow(double dt);
  Gust airNow() const;
  void judge();

  mutable std::mutex mutex_;
  SimulationOptions options_;
  Random random_;
  Dynamics dynamics_;
  Gust gust_;
  Eigen::Vector3d ordered_wind_ = Eigen::Vector3d::Zero();  ///< at the ordered gust's height
  double ordered_since_s_ = 0.0;
  double ordered_duration_s_ = 0.0;
  std::vector<Knock> knocks_;
  std::array<std::optional<RigidTransform>, kMaxCameras> true_from_knocked_;
  std::deque<Command> commands_;
  StickDemand sticks_;
  std::int64_t step_ = 0;
  std::int64_t earliest_placing_;
  std::int64_t placed_at_step_ = -1;  ///< not yet
  int holds_ = 0;
  std::int64_t cleared_from_ = 0;  ///< steps
  std::int64_t cleared_until_ = 0;
  double upper_angle_ = 0.0;
  double lower_angle_ = 0.0;
  std::optional<CarriedPath> carried_;
  std::vector<WorldSample> history_;  // ring, by step
  Verdict verdict_;
};

}  // namespace helical
