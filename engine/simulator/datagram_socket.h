#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace helical {

/// The other end of a datagram; port 0: nobody.
struct Peer {
  std::uint32_t ip = 0;  ///< host byte order
  std::uint16_t port = 0;
  bool operator==(const Peer&) const = default;
};

/// A UDP socket that closes itself. One thread sends and one receives.
class DatagramSocket {
 public:
  /// Bound to an address of this machine, or to the broadcast address, which several sockets may share. Port 0: any
  /// that is free. Throws Error(kSystem).
  DatagramSocket(std::uint32_t ip, std::uint16_t port);
  ~DatagramSocket();
  DatagramSocket(const DatagramSocket&) = delete;
  DatagramSocket& operator=(const DatagramSocket&) = delete;

  /// The length of a datagram that was waiting; below 0: there was none.
  int receive(std::span<std::uint8_t> into, Peer& from);
  void send(std::span<const std::uint8_t> bytes, const Peer& to);
  std::uint16_t port() const;
  int descriptor() const { return descriptor_; }

 private:
  int descriptor_;
};

/// "127.0.0.2" in host byte order. Throws Error(kInput).
std::uint32_t parseIp(const std::string& text);
/// "127.0.0.1:5391". Throws Error(kInput).
Peer parsePeer(const std::string& text);

}  // namespace helical
