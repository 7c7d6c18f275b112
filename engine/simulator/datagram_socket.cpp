#include "engine/simulator/datagram_socket.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <cstring>
#include <string>

#include "engine/base/error.h"

namespace helical {
namespace {

constexpr int kSendBuffer = 4 << 20;

sockaddr_in toSystem(const Peer& peer) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(peer.port);
  address.sin_addr.s_addr = htonl(peer.ip);
  return address;
}

std::string nameOf(const Peer& peer) {
  char text[INET_ADDRSTRLEN];
  const in_addr address{htonl(peer.ip)};
  inet_ntop(AF_INET, &address, text, sizeof text);
  return std::string(text) + ":" + std::to_string(peer.port);
}

}  // namespace

DatagramSocket::DatagramSocket(std::uint32_t ip, std::uint16_t port)
    : descriptor_(socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0)) {
  const int on = 1;
  if (ip == INADDR_BROADCAST) setsockopt(descriptor_, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
  setsockopt(descriptor_, SOL_SOCKET, SO_SNDBUF, &kSendBuffer, sizeof kSendBuffer);
  const sockaddr_in address = toSystem({ip, port});
  if (bind(descriptor_, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0) return;
  const int reason = errno;
  close(descriptor_);
  throw Error(ErrorKind::kSystem, std::string("the address cannot be used: ") + std::strerror(reason),
              nameOf({ip, port}), "stop the other program that serves it, or serve on other addresses");
}

DatagramSocket::~DatagramSocket() {
  close(descriptor_);
}

int DatagramSocket::receive(std::span<std::uint8_t> into, Peer& from) {
  sockaddr_in address{};
  socklen_t length = sizeof address;
  const auto size = recvfrom(descriptor_, into.data(), into.size(), MSG_DONTWAIT,
                             reinterpret_cast<sockaddr*>(&address), &length);
  from = {ntohl(address.sin_addr.s_addr), ntohs(address.sin_port)};
  return static_cast<int>(size);
}

void DatagramSocket::send(std::span<const std::uint8_t> bytes, const Peer& to) {
  const sockaddr_in address = toSystem(to);
  sendto(descriptor_, bytes.data(), bytes.size(), 0, reinterpret_cast<const sockaddr*>(&address), sizeof address);
}

std::uint16_t DatagramSocket::port() const {
  sockaddr_in address{};
  socklen_t length = sizeof address;
  getsockname(descriptor_, reinterpret_cast<sockaddr*>(&address), &length);
  return ntohs(address.sin_port);
}

std::uint32_t parseIp(const std::string& text) {
  in_addr address{};
  if (inet_pton(AF_INET, text.c_str(), &address) != 1)
    throw Error(ErrorKind::kInput, "'" + text + "' is no IP address", {}, "give one like 127.0.0.2");
  return ntohl(address.s_addr);
}

Peer parsePeer(const std::string& text) {
  const std::size_t colon = text.find(':');
  int port = 0;
  const char* const end = text.data() + text.size();
  const auto [next, code] =
      colon == std::string::npos ? std::from_chars_result{end, std::errc::invalid_argument}
                                 : std::from_chars(text.data() + colon + 1, end, port);
  if (code != std::errc() || next != end || port < 1 || port > 65535)
    throw Error(ErrorKind::kInput, "'" + text + "' is no address with a port", {}, "give one like 127.0.0.1:5391");
  return {parseIp(text.substr(0, colon)), static_cast<std::uint16_t>(port)};
}

}  // namespace helical
