#include "engine/cameras/aravis/gvcp_action.h"

#include <arpa/inet.h>
#include <sys/socket.h>
#include <unistd.h>

#include <vector>

namespace helical {
namespace {

constexpr std::uint16_t kControlPort = 3956;
constexpr std::uint8_t kMagic = 0x42, kAtATime = 0x80;

}  // namespace

void sendAction(const std::string& ip, std::optional<TimeNs> when) {
  sockaddr_in camera{};
  camera.sin_family = AF_INET;
  camera.sin_port = htons(kControlPort);
  if (inet_pton(AF_INET, ip.c_str(), &camera.sin_addr) != 1) return;
  std::vector<std::uint32_t> words{kActionDeviceKey, kActionGroupKey, kActionGroupMask};
  if (when) {
    const auto time = static_cast<std::uint64_t>(*when);
    words.push_back(static_cast<std::uint32_t>(time >> 32));
    words.push_back(static_cast<std::uint32_t>(time));
  }
  std::vector<std::uint8_t> packet{kMagic, when ? kAtATime : std::uint8_t{0}, 0x01, 0x00, 0x00,
                                   static_cast<std::uint8_t>(4 * words.size()), 0x00, 0x01};
  for (const std::uint32_t word : words)
    for (int shift = 24; shift >= 0; shift -= 8) packet.push_back(static_cast<std::uint8_t>(word >> shift));
  const int socket_descriptor = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  sendto(socket_descriptor, packet.data(), packet.size(), 0, reinterpret_cast<const sockaddr*>(&camera), sizeof camera);
  close(socket_descriptor);
}

}  // namespace helical
