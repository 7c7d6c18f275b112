#pragma once

#include <atomic>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>

#include "engine/cameras/frame.h"
#include "engine/simulator/gige/control_channel.h"
#include "engine/simulator/gige/device_state.h"
#include "engine/simulator/gige/frame_sender.h"
#include "engine/simulator/gige/sensor_readout.h"

namespace helical::gige {

/// What is wrong with a virtual camera for now.
struct CameraFaults {
  double loss = 0.0;      ///< share of packets that never arrive
  double jitter_s = 0.0;  ///< frames are sent up to so much later
  bool mute = false;      ///< neither frames nor answers: the cable is out
  bool taken = false;     ///< another host has taken control
  bool operator==(const CameraFaults&) const = default;
};

/// A simulated camera as a GigE Vision device on an address of this machine: any client of that standard can use it.
/// Exposes on a grid of its own clock, or when triggered. Two threads of its own; methods from any thread.
class VirtualCamera {
 public:
  /// The picture (BGR, of the sensor's size) at a mid-exposure on CLOCK_MONOTONIC; valid until the next call. On the
  /// stream thread.
  using Lens = std::function<ImageView(TimeNs mid_exposure)>;

  struct Options {
    Identity identity;
    double readout_s = 0.008;  ///< mid-exposure to the first packet, at most half a frame
    std::uint64_t seed = 1;    ///< of phase and lost packets
  };

  struct Counts {
    std::uint64_t frames = 0;
    std::uint64_t missed = 0;  ///< exposures that this machine was too slow for
    std::uint64_t resent = 0;  ///< packets
  };

  /// Answers from now on. Throws Error(kSystem) when the address is taken.
  VirtualCamera(const Options& options, Lens lens);
  ~VirtualCamera();
  VirtualCamera(const VirtualCamera&) = delete;
  VirtualCamera& operator=(const VirtualCamera&) = delete;

  void setFaults(const CameraFaults& faults);
  /// Its clock from now on: off by `offset_s` beside what it would be, fast by `drift`.
  void setClock(double offset_s, double drift);
  /// Exposes, if it waits for line 1.
  void pulseLine();
  /// Forgets everything, and is silent for `off_s`.
  void reboot(double off_s);

  bool streaming() const { return streaming_.load(std::memory_order_relaxed); }
  bool controlled() const;
  Counts counts() const;

 private:
  void control(const std::stop_token& stop);
  void stream(const std::stop_token& stop);
  void expose(const Exposing& exposing, TimeNs mid_exposure);
  TimeNs nextExposure(const Exposing& exposing, TimeNs now);
  CameraFaults faults() const;
  /// With chunks, a frame's own timestamp is that of its way out, as with cameras that stamp their packets.
  TimeNs deviceNow() const;
  bool waitForTrigger(TimeNs& mid_exposure, const Exposing& exposing);

  const Options options_;
  Lens lens_;
  mutable std::mutex mutex_;  ///< guards state_, faults_, silent_until_
  std::condition_variable changed_;
  DeviceState state_;
  CameraFaults faults_;
  TimeNs silent_until_ = 0;

  Random random_;  ///< stream thread, as all below
  double phase_;
  FrameSender sender_;
  SensorReadout readout_;
  std::uint16_t id_ = 0;
  TimeNs last_exposure_ = 0;  ///< on the device's clock
  double last_rate_ = 0.0;

  std::atomic<bool> streaming_{false};
  std::atomic<std::uint64_t> frames_{0};
  std::atomic<std::uint64_t> missed_{0};
  ControlChannel channel_;
  std::jthread control_thread_;
  std::jthread stream_thread_;
};

}  // namespace helical::gige
