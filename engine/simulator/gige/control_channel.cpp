#include "engine/simulator/gige/control_channel.h"

#include <poll.h>

#include <algorithm>
#include <optional>

#include "engine/base/monotonic.h"

namespace helical::gige {
namespace {

constexpr std::uint16_t kControlPort = 3956;
constexpr std::uint32_t kEverybody = 0xffffffff;
constexpr std::size_t kHeader = 8;
constexpr std::uint8_t kMagic = 0x42;
constexpr std::uint8_t kScheduled = 0x80;
constexpr std::size_t kLargestRead = 536;

enum Command : std::uint16_t {
  kDiscovery = 0x0002,
  kResend = 0x0040,
  kReadRegister = 0x0080,
  kWriteRegister = 0x0082,
  kReadMemory = 0x0084,
  kWriteMemory = 0x0086,
  kAction = 0x0100,
};

}  // namespace

std::uint32_t ControlChannel::Request::word(std::size_t at) const {
  std::uint32_t value = 0;
  for (std::size_t i = at; i < at + 4; ++i) value = value << 8 | (i < data.size() ? data[i] : 0U);
  return value;
}

void ControlChannel::Answer::put(std::span<const std::uint8_t> bytes_to_add) {
  const std::size_t count = std::min(bytes_to_add.size(), bytes.size() - kHeader - size);
  std::copy_n(bytes_to_add.begin(), count, bytes.begin() + static_cast<std::ptrdiff_t>(kHeader + size));
  size += count;
}

void ControlChannel::Answer::put(std::uint32_t word) {
  const std::array<std::uint8_t, 4> big_endian{static_cast<std::uint8_t>(word >> 24),
                                               static_cast<std::uint8_t>(word >> 16),
                                               static_cast<std::uint8_t>(word >> 8), static_cast<std::uint8_t>(word)};
  put(big_endian);
}

ControlChannel::ControlChannel(std::uint32_t ip, DeviceState& state, std::mutex& mutex, FrameSender& sender)
    : socket_(ip, kControlPort), broadcast_(kEverybody, kControlPort), state_(state), mutex_(mutex), sender_(sender) {}

bool ControlChannel::serve(int timeout_ms, bool mute, double loss) {
  pollfd waiting[] = {{socket_.descriptor(), POLLIN, 0}, {broadcast_.descriptor(), POLLIN, 0}};
  if (poll(waiting, 2, timeout_ms) <= 0) return false;
  if ((waiting[0].revents & POLLIN) != 0) receive(socket_, mute, loss);
  if ((waiting[1].revents & POLLIN) != 0) receive(broadcast_, mute, loss);
  return true;
}

void ControlChannel::receive(DatagramSocket& socket, bool mute, double loss) {
  std::array<std::uint8_t, 2048> datagram;
  Peer from;
  const int received = socket.receive(datagram, from);
  if (mute || received < static_cast<int>(kHeader) || datagram[0] != kMagic) return;
  Request request;
  request.wants_answer = (datagram[1] & 1) != 0;
  request.scheduled = (datagram[1] & kScheduled) != 0;
  request.command = static_cast<std::uint16_t>(datagram[2] << 8 | datagram[3]);
  request.id = static_cast<std::uint16_t>(datagram[6] << 8 | datagram[7]);
  const std::size_t length = static_cast<std::size_t>(datagram[4] << 8 | datagram[5]);
  if (kHeader + length > static_cast<std::size_t>(received)) return;
  request.data = std::span(datagram).subspan(kHeader, length);
  Answer answer;
  if (handle(request, from, loss, answer)) answerTo(request, answer, from);
}

bool ControlChannel::handle(const Request& request, const Peer& from, double loss, Answer& answer) {
  if (request.command == kResend) {
    const auto id = static_cast<std::uint16_t>(request.word(0));
    sender_.resend(id, request.word(4) & 0xffffff, request.word(8) & 0xffffff, loss);
    return false;
  }
  std::optional<Exposing> test_packet;
  {
    const std::lock_guard lock(mutex_);
    state_.heard(from, monotonicNow());
    switch (request.command) {
      case kDiscovery:
        answer.put(state_.discoveryBlock());
        break;
      case kReadRegister:
        readRegisters(request, answer);
        break;
      case kWriteRegister:
        writeRegisters(request, from, answer);
        break;
      case kReadMemory:
        readMemory(request, answer);
        break;
      case kWriteMemory:
        writeMemory(request, from, answer);
        break;
      case kAction:
        if (state_.actionIsMine(request.word(0), request.word(4), request.word(8))) act(request);
        break;
      default:
        answer.status = Status::kNotImplemented;
    }
    if (state_.takeTestPacketOrder()) test_packet = state_.exposing();
  }
  if (test_packet) sender_.sendTestPacket(*test_packet);
  return request.wants_answer || request.command == kDiscovery;
}

void ControlChannel::act(const Request& request) {
  const TimeNs now = monotonicNow();
  const auto when = static_cast<TimeNs>(std::uint64_t{request.word(12)} << 32 | request.word(16));
  state_.triggerAt(request.scheduled ? when : state_.deviceTime(now), now);
}

void ControlChannel::readRegisters(const Request& request, Answer& answer) {
  for (std::size_t at = 0; at + 4 <= request.data.size() && answer.status == Status::kSuccess; at += 4) {
    std::uint32_t value = 0;
    answer.status = state_.read(request.word(at), value);
    if (answer.status == Status::kSuccess) answer.put(value);
  }
}

void ControlChannel::writeRegisters(const Request& request, const Peer& from, Answer& answer) {
  std::uint32_t written = 0;
  for (std::size_t at = 0; at + 8 <= request.data.size() && answer.status == Status::kSuccess; at += 8) {
    answer.status = state_.write(request.word(at), request.word(at + 4), from, monotonicNow());
    written += answer.status == Status::kSuccess ? 1 : 0;
  }
  answer.put(written);
}

void ControlChannel::readMemory(const Request& request, Answer& answer) {
  const std::uint32_t address = request.word(0), size = request.word(4) & 0xffff;
  std::span<const std::uint8_t> bytes;
  answer.status = size > kLargestRead ? Status::kInvalidParameter : state_.read(address, size, bytes);
  if (answer.status != Status::kSuccess) return;
  answer.put(address);
  answer.put(bytes);
}

void ControlChannel::writeMemory(const Request& request, const Peer& from, Answer& answer) {
  if (request.data.size() < 8) {
    answer.status = Status::kInvalidParameter;
    return;
  }
  const auto bytes = request.data.subspan(4);
  answer.status = state_.write(request.word(0), bytes, from, monotonicNow());
  answer.put(answer.status == Status::kSuccess ? static_cast<std::uint32_t>(bytes.size()) : 0U);
}

void ControlChannel::answerTo(const Request& request, Answer& answer, const Peer& to) {
  const auto put16 = [&](std::size_t at, std::size_t value) {
    answer.bytes[at] = static_cast<std::uint8_t>(value >> 8);
    answer.bytes[at + 1] = static_cast<std::uint8_t>(value);
  };
  put16(0, static_cast<std::size_t>(answer.status));
  put16(2, request.command + 1U);
  put16(4, answer.size);
  put16(6, request.id);
  socket_.send(std::span(answer.bytes).first(kHeader + answer.size), to);
}

}  // namespace helical::gige
