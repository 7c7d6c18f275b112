#include "engine/cameras/aravis/gvcp_probe.h"

#include <arpa/inet.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cstdint>

namespace helical {
namespace {

constexpr std::uint16_t kControlPort = 3956;
/// READREG of the control channel privilege, with an answer wanted.
constexpr std::array<std::uint8_t, 12> kRequest{0x42, 0x01, 0x00, 0x80, 0x00, 0x04, 0x00, 0x01, 0x00, 0x00, 0x0a, 0x00};
constexpr std::uint8_t kPrivileges = 3;

}  // namespace

bool isIpAddress(const std::string& text) {
  in_addr address{};
  return inet_pton(AF_INET, text.c_str(), &address) == 1;
}

ProbeAnswer probe(const std::string& ip, int timeout_ms) {
  sockaddr_in camera{};
  camera.sin_family = AF_INET;
  camera.sin_port = htons(kControlPort);
  if (inet_pton(AF_INET, ip.c_str(), &camera.sin_addr) != 1) return ProbeAnswer::kSilent;
  const int socket_descriptor = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  ProbeAnswer result = ProbeAnswer::kSilent;
  pollfd waiting{socket_descriptor, POLLIN, 0};
  std::array<std::uint8_t, 64> answer{};
  // Connected, so that a machine without a camera says so at once.
  if (connect(socket_descriptor, reinterpret_cast<const sockaddr*>(&camera), sizeof camera) == 0 &&
      send(socket_descriptor, kRequest.data(), kRequest.size(), 0) > 0 && poll(&waiting, 1, timeout_ms) > 0 &&
      recv(socket_descriptor, answer.data(), answer.size(), MSG_DONTWAIT) >= 12)
    result = (answer[11] & kPrivileges) != 0 ? ProbeAnswer::kControlled : ProbeAnswer::kFree;
  close(socket_descriptor);
  return result;
}

}  // namespace helical
