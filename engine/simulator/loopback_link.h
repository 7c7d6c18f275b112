#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <string>
#include <thread>

#include "engine/simulator/datagram_socket.h"
#include "engine/transmitter/transmitter.h"

namespace helical {

/// Where a loopback transmitter's sticks go unless the rig says otherwise.
inline constexpr const char* kLoopbackAddress = "127.0.0.1:5391";

/// A transmitter whose radio is a UDP socket of this machine: it steers the helicopter of another process' simulated
/// field (`helical serve`). One thread.
class LoopbackTransmitter final : public Transmitter {
 public:
  /// Throws Error(kInput) for what is no address, Error(kSystem) without a socket.
  explicit LoopbackTransmitter(const std::string& address);
  void send(const StickDemand& demand, TimeNs now) override;

 private:
  Peer to_;
  DatagramSocket socket_;
  std::uint32_t sequence_ = 0;
};

/// The other end. A thread of its own hands over what arrives; packets that overtook each other are left out.
class LoopbackReceiver {
 public:
  /// `when`: of its arrival, on CLOCK_MONOTONIC.
  using Sink = std::function<void(const StickDemand& demand, TimeNs when)>;

  /// Throws Error(kSystem) when the address is taken.
  LoopbackReceiver(const std::string& address, Sink sink);

 private:
  void receive(const std::stop_token& stop);

  Sink sink_;
  DatagramSocket socket_;
  std::jthread thread_;
};

}  // namespace helical
