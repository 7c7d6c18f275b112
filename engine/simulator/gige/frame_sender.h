#pragma once

#include <array>
#include <cstdint>
#include <mutex>
#include <vector>

#include "engine/base/random.h"
#include "engine/simulator/datagram_socket.h"
#include "engine/simulator/gige/device_state.h"

namespace helical::gige {

/// The stream channel: cuts frames into packets (GVSP 1.2), sends them, keeps the last eight to send packets again.
/// The stream thread fills and sends, the control thread resends.
class FrameSender {
 public:
  explicit FrameSender(std::uint32_t ip, Random random) : socket_(ip, 0), random_(random) {}

  /// Room for the next frame's pixels and chunks; `send` follows.
  std::vector<std::uint8_t>& payload(std::size_t size);
  /// Sends what was filled in. `loss`: share of packets that never arrive.
  void send(std::uint16_t id, TimeNs timestamp, const Exposing& exposing, double loss);
  /// Packets `first` to `last` of a frame that is still known. `loss` takes some of them, too.
  void resend(std::uint16_t id, std::uint32_t first, std::uint32_t last, double loss);
  /// Asked for by clients that look for the largest packet that arrives.
  void sendTestPacket(const Exposing& exposing);

  std::uint64_t resent() const;

 private:
  struct KeptFrame {
    std::uint16_t id = 0;
    TimeNs timestamp = 0;
    Exposing exposing;
    std::vector<std::uint8_t> payload;
    std::uint32_t packets() const;
    std::uint32_t block() const;
  };
  void sendPackets(const KeptFrame& frame, std::uint32_t first, std::uint32_t last, double loss);

  DatagramSocket socket_;
  mutable std::mutex mutex_;
  Random random_;
  std::array<KeptFrame, 8> kept_;
  std::size_t next_ = 0;
  std::uint64_t resent_ = 0;
};

}  // namespace helical::gige
