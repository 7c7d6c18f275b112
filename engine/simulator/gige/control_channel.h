#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <mutex>
#include <span>

#include "engine/simulator/datagram_socket.h"
#include "engine/simulator/gige/device_state.h"
#include "engine/simulator/gige/frame_sender.h"

namespace helical::gige {

/// The control channel (GVCP 1.2): answers discovery, reads and writes registers, resends packets, hears actions.
/// One thread calls `serve`.
class ControlChannel {
 public:
  /// `mutex` guards `state`. Throws Error(kSystem) when the address is taken.
  ControlChannel(std::uint32_t ip, DeviceState& state, std::mutex& mutex, FrameSender& sender);

  /// Answers what comes within `timeout_ms`, or nothing while it is `mute`. `loss` as for frames. True if something
  /// came.
  bool serve(int timeout_ms, bool mute, double loss);

 private:
  struct Request {
    std::uint16_t command = 0;
    std::uint16_t id = 0;
    bool wants_answer = false;
    bool scheduled = false;  ///< an action with a time
    std::span<const std::uint8_t> data;
    std::uint32_t word(std::size_t at) const;
  };
  struct Answer {
    Status status = Status::kSuccess;
    std::size_t size = 0;
    std::array<std::uint8_t, 1400> bytes{};  ///< header of 8 first
    void put(std::span<const std::uint8_t> bytes_to_add);
    void put(std::uint32_t word);
  };
  void receive(DatagramSocket& socket, bool mute, double loss);
  bool handle(const Request& request, const Peer& from, double loss, Answer& answer);
  void act(const Request& request);
  void readRegisters(const Request& request, Answer& answer);
  void writeRegisters(const Request& request, const Peer& from, Answer& answer);
  void readMemory(const Request& request, Answer& answer);
  void writeMemory(const Request& request, const Peer& from, Answer& answer);
  void answerTo(const Request& request, Answer& answer, const Peer& to);

  DatagramSocket socket_;
  DatagramSocket broadcast_;
  DeviceState& state_;
  std::mutex& mutex_;
  FrameSender& sender_;
};

}  // namespace helical::gige
