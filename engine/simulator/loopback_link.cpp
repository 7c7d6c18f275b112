#include "engine/simulator/loopback_link.h"

#include <poll.h>

#include <array>
#include <cmath>
#include <cstring>
#include <utility>

#include "engine/base/monotonic.h"

namespace helical {
namespace {

constexpr std::uint32_t kMagic = 0x48'4c'53'31;  // "HLS1"
constexpr int kTimeoutMs = 50;
constexpr std::uint32_t kLocalhost = 0x7f000001;

/// Both ends are on one machine: as it lies in memory.
struct StickPacket {
  std::uint32_t magic = kMagic;
  std::uint32_t sequence = 0;
  std::array<float, 4> sticks{};
};
static_assert(sizeof(StickPacket) == 24);

}  // namespace

LoopbackTransmitter::LoopbackTransmitter(const std::string& address)
    : to_(parsePeer(address)), socket_(kLocalhost, 0) {}

void LoopbackTransmitter::send(const StickDemand& demand, TimeNs /*now*/) {
  StickPacket packet;
  packet.sequence = ++sequence_;
  packet.sticks = {static_cast<float>(demand.upper_rotor), static_cast<float>(demand.lower_rotor),
                   static_cast<float>(demand.roll), static_cast<float>(demand.pitch)};
  std::array<std::uint8_t, sizeof packet> bytes;
  std::memcpy(bytes.data(), &packet, sizeof packet);
  socket_.send(bytes, to_);
}

LoopbackReceiver::LoopbackReceiver(const std::string& address, Sink sink)
    : sink_(std::move(sink)), socket_(parsePeer(address).ip, parsePeer(address).port) {
  thread_ = std::jthread([this](const std::stop_token& stop) { receive(stop); });
}

void LoopbackReceiver::receive(const std::stop_token& stop) {
  Peer sender;
  std::uint32_t newest = 0;
  while (!stop.stop_requested()) {
    pollfd waiting{socket_.descriptor(), POLLIN, 0};
    if (poll(&waiting, 1, kTimeoutMs) <= 0) continue;
    StickPacket packet;
    std::array<std::uint8_t, sizeof packet> bytes;
    Peer from;
    if (socket_.receive(bytes, from) != static_cast<int>(sizeof packet)) continue;
    std::memcpy(&packet, bytes.data(), sizeof packet);
    bool finite = true;
    for (const float stick : packet.sticks) finite = finite && std::isfinite(stick);
    if (packet.magic != kMagic || !finite) continue;
    if (from == sender && packet.sequence <= newest) continue;
    sender = from;
    newest = packet.sequence;
    sink_({packet.sticks[0], packet.sticks[1], packet.sticks[2], packet.sticks[3]}, monotonicNow());
  }
}

}  // namespace helical
