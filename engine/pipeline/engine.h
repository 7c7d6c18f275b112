#pragma once

#include <memory>
#include <string>
#include <vector>

#include "engine/config/rig_config.h"
#include "engine/flight/flight_plan.h"
#include "engine/pipeline/snapshot.h"
#include "engine/pipeline/white_board.h"

namespace helical {

class FlightTap;

/// A flight in real time: one capture thread per camera, one tracking and flight thread, one output thread.
/// This is the whole of the engine that the window knows. Reading methods are for one thread (the window's);
/// none of them blocks the engine, nor does the engine ever wait for them.
class Engine {
 public:
  /// Builds sources and transmitter as the rig says. Throws Error when something is missing. `tap` sees the
  /// flight on its thread until `stop` and outlives the engine.
  Engine(const RigConfig& rig, const FlightPlan& plan, FlightTap* tap = nullptr);
  ~Engine();  ///< stops: rotors off first
  Engine(const Engine&) = delete;
  Engine& operator=(const Engine&) = delete;

  const RigConfig& rig() const;
  const FlightPlan& plan() const;

  /// Once in the engine's life: after a stop the rotors stay off.
  void start();
  void stop();
  bool running() const;

  /// Commands: any thread, wait-free.
  void takeOff();  ///< starts the plan from the ground
  void land();     ///< lands where it is
  void kill();     ///< rotors off at once, latched; bypasses every queue
  void hideCamera(CameraId camera, bool hidden);
  /// In simulation: somebody knocks the camera, the air moves. Nothing happens on a real rig.
  void knockCamera(CameraId camera, double angle, double distance);    ///< rad, m
  void gust(const Eigen::Vector3d& wind_in_world, double duration_s);  ///< m/s at its height

  /// Orders of the reading thread; wait-free for the engine.
  /// All boards before a camera from now on, for real cameras too: its frames show them.
  void setBoards(CameraId camera, const WhiteBoards& boards);
  /// Cameras that learn their pose start anew from their first guess with this method, and leave the control
  /// set until they are admitted again; the others will use it once they are knocked. Throws Error(kInput)
  /// for an unknown one.
  void setCalibrator(const std::string& method);
  const std::string& calibrator() const;
  static std::vector<std::string> calibrators();  ///< in the order users are shown
  /// The same for one camera, with the method of the others.
  void restartCalibration(CameraId camera);

  /// True if `snapshot()` is newer than at the last call.
  bool poll();
  const EngineSnapshot& snapshot() const;

  /// Newest picture of a camera at display rate; false if there is none since the last call.
  bool pollPicture(CameraId camera);
  const CameraPicture& picture(CameraId camera) const;

  /// What a camera's calibrator believes, at display rate; false if there is nothing new since the last call.
  bool pollCalibration(CameraId camera);
  const CalibrationView& calibration(CameraId camera) const;

  /// Every control tick's snapshot in order, for plots that must not miss one; false when there is none.
  bool nextTick(EngineSnapshot& tick);
  bool nextEvent(EngineEvent& event);
  /// Ticks and events lost because the window did not fetch them in time.
  std::uint64_t lostTicks() const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace helical
