#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/flight/flight_change.h"
#include "engine/pipeline/calibration_order.h"
#include "engine/pipeline/flight_view.h"
#include "engine/pipeline/white_board.h"

namespace helical {

class FlightTap;

/// A flight in real time: one capture thread per camera, one tracking and flight thread, one output thread.
/// This is the whole of the engine that the window knows. What it shows, it shows as a FlightView.
class Engine final : public FlightView {
 public:
  /// Builds sources and transmitter as the rig says. Throws Error when something is missing. `tap` sees the
  /// flight on its thread until `stop` and outlives the engine.
  Engine(const RigConfig& rig, const FlightPlan& plan, FlightTap* tap = nullptr);
  ~Engine() override;  ///< stops: rotors off first
  Engine(const Engine&) = delete;
  Engine& operator=(const Engine&) = delete;

  const RigConfig& rig() const override;
  const FlightPlan& plan() const override;   ///< as last ordered
  const ControllerOptions& control() const;  ///< as last ordered

  /// Once in the engine's life: after a stop the rotors stay off.
  void start();
  void stop();
  bool running() const;

  /// Commands: any thread, wait-free.
  void arm();      ///< allows the rotors to turn, unless a pre-arm check fails: `arm_refused` tells which
  void disarm();   ///< forbids it again; with the rotors off
  void takeOff();  ///< starts the plan from the ground, if it is armed; in the air, ends a hold
  void hold();     ///< stays where it is
  void land();     ///< lands where it is
  void kill();     ///< rotors off at once, latched; bypasses every queue
  void hideCamera(CameraId camera, bool hidden);
  /// In simulation: somebody knocks the camera, the air moves. Nothing happens on a real rig.
  void knockCamera(CameraId camera, double angle, double distance);    ///< rad, m
  void gust(const Eigen::Vector3d& wind_in_world, double duration_s);  ///< m/s at its height

  /// Orders of the reading thread; wait-free for the engine.
  /// All boards before a camera from now on, for real cameras too: its frames show them.
  void setBoards(CameraId camera, const WhiteBoards& boards);
  /// A share of a camera's frames (0 to 1) gets lost on the way from now on; noise is added to the others
  /// (standard deviation in grey levels for images, in px to the centroids of sources without).
  void loseFrames(CameraId camera, double share);
  void addNoise(CameraId camera, double grey_levels, double px);
  /// No marker is looked for in these areas of a camera's image, in place of the rig file's.
  void setIgnoredAreas(CameraId camera, const IgnoredAreas& areas);
  /// Every camera looks for markers of this colour from now on, beside the rig file's other ones. Throws
  /// Error(kInput) for a range out of HSV. Takes some 100 ms.
  void setMarkerColour(const ColourRange& colour);
  const ColourRange& markerColour() const;
  /// Each camera with images averages a new background of the field as it is now; until then it finds
  /// nothing. Simulated rigs clear the field for as long. Throws Error(kInput) unless the rotors are off: a
  /// helicopter in the background is not seen, and in flight there would be no pose for a moment.
  void takeBackground();
  /// Plan, gains and trims: all at one control tick. Throws Error(kInput) and changes nothing if `validate`
  /// refuses.
  void change(const FlightChange& change);
  /// Cameras that learn their pose start anew from their first guess with this method, and leave the control
  /// set until they are admitted again; the others will use it once they are knocked. Throws Error(kInput)
  /// for an unknown one.
  void setCalibrator(const std::string& method);
  const std::string& calibrator() const;
  static std::vector<std::string> calibrators();  ///< in the order users are shown
  /// The same for one camera, with the method of the others.
  void restartCalibration(CameraId camera);
  /// Decided about one camera, carried out at the next control tick; what cannot be done is told as an event.
  /// False if more orders wait than the engine keeps.
  bool orderCalibration(const CalibrationOrder& order);
  /// Where the cameras of the control set stand, with covariance and provenance, to a file; `orderCalibration`
  /// with what such a file says, for every camera that it names. With `only` it is about this one. Both throw
  /// Error; the latter orders nothing then.
  void saveCalibration(const std::filesystem::path& file, std::optional<CameraId> only = {}) const;
  void adoptCalibration(const std::filesystem::path& file, std::optional<CameraId> only = {});

  // FlightView.
  bool poll() override;
  const EngineSnapshot& snapshot() const override;
  bool pollPicture(CameraId camera) override;
  const CameraPicture& picture(CameraId camera) const override;
  bool pollCalibration(CameraId camera) override;
  const CalibrationView& calibration(CameraId camera) const override;
  bool nextTick(EngineSnapshot& tick) override;
  bool nextEvent(EngineEvent& event) override;
  std::uint64_t lostTicks() const override;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace helical
