#pragma once

#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "engine/geometry/camera_model.h"
#include "engine/helicopter/helicopter_parameters.h"
#include "engine/helicopter/marker_layout.h"
#include "engine/simulator/field_keeper.h"
#include "engine/simulator/gige/virtual_camera.h"
#include "engine/simulator/loopback_link.h"
#include "engine/simulator/simulated_transmitter.h"
#include "engine/simulator/world.h"

namespace helical {

/// One camera of a virtual rig.
struct VirtualCameraPlace {
  std::string address;  ///< "127.0.0.2"
  std::string name;
  CameraModel model;
  RigidTransform camera_from_world;  ///< as it truly is
};

struct VirtualRigOptions {
  std::vector<VirtualCameraPlace> cameras;
  MarkerLayout markers = MarkerLayout::paper();
  HelicopterParameters helicopter = HelicopterParameters::xrb();
  SimulationOptions simulation;
  int background_frames = 8;  ///< that a client needs of the empty field
  std::string transmitter = kLoopbackAddress;
};

/// Something goes wrong with one camera for a while.
struct ScheduledFault {
  enum class Kind { kLoss, kJitter, kMute, kTaken, kReboot, kClock };
  Kind kind = Kind::kMute;
  std::size_t camera = 0;
  double from_s = 0.0;
  double to_s = 0.0;
  double value = 0.0;  ///< share, s, -, -, -, offset in s
  double drift = 0.0;  ///< of kClock, relative
};

/// The simulated field as real devices on this machine: its cameras speak GigE Vision, its helicopter listens to a
/// loopback transmitter. Real time, threads of its own.
///
/// When a transmitter is switched on (its first packet, or the first after two silent seconds), the field is emptied, and
/// a helicopter is put there when its keeper says that the cameras have seen it empty. Scheduled times count from when
/// the transmitter was switched on, or from the start while there was none. A helicopter that hears nothing for half a
/// second stops its rotors.
class VirtualRig {
 public:
  /// Throws Error(kSystem) when an address is taken.
  VirtualRig(const VirtualRigOptions& options, std::vector<ScheduledFault> faults);
  ~VirtualRig();
  VirtualRig(const VirtualRig&) = delete;
  VirtualRig& operator=(const VirtualRig&) = delete;

  std::size_t cameraCount() const { return cameras_.size(); }
  const gige::VirtualCamera& camera(std::size_t index) const { return *cameras_[index]; }
  /// Of the flight that is going on, or was the last.
  Verdict verdict() const;
  /// Seconds since a transmitter was switched on; below 0: never yet.
  double flightTime() const;

 private:
  struct Field {
    std::shared_ptr<World> world;
    TimeNs began = 0;  ///< on CLOCK_MONOTONIC
  };
  class Lens;
  Field field() const;
  void renewField(TimeNs now);
  void onSticks(const StickDemand& demand, TimeNs when);
  void watch(const std::stop_token& stop);
  bool transmitterOn(TimeNs now) const;
  void keepField(TimeNs now);
  void applyFaults(TimeNs now);

  const VirtualRigOptions options_;
  std::vector<ScheduledFault> faults_;
  mutable std::mutex mutex_;  ///< guards the next eight
  Field field_;
  std::shared_ptr<World> flown_;  ///< the world of the flight that is going on, or was the last
  std::unique_ptr<SimulatedTransmitter> radio_;
  TimeNs switched_on_ = -1;
  TimeNs last_packet_ = -1;
  bool held_empty_ = false;
  bool rotors_stopped_ = true;
  FieldKeeper keeper_;

  std::vector<std::unique_ptr<Lens>> lenses_;
  std::vector<std::unique_ptr<gige::VirtualCamera>> cameras_;
  std::vector<bool> done_;  ///< faults that happen once; watching thread
  std::unique_ptr<LoopbackReceiver> receiver_;
  std::jthread watcher_;
};

}  // namespace helical
