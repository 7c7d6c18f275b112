#include "engine/simulator/gige/frame_sender.h"

#include <netinet/in.h>
#include <sys/socket.h>

#include <algorithm>
#include <cstring>
#include <ctime>

namespace helical::gige {
namespace {

constexpr std::uint32_t kHeaders = 20 + 8 + 8;  // IP, UDP and stream header count as part of a packet's size
constexpr std::uint32_t kUdpHeaders = 20 + 8;
constexpr unsigned kBatch = 64;
constexpr std::uint8_t kLeader = 1, kTrailer = 2, kPayload = 3;
constexpr std::uint32_t kImage = 1, kImageWithChunks = 0x4001;

/// Header of one packet, in network byte order.
struct PacketHeader {
  std::array<std::uint8_t, 48> bytes;
  std::size_t size = 0;

  void put(std::uint32_t value) {
    for (int shift = 24; shift >= 0; shift -= 8) bytes[size++] = static_cast<std::uint8_t>(value >> shift);
  }
};

}  // namespace

std::uint32_t FrameSender::KeptFrame::block() const {
  return exposing.packet_size - kHeaders;
}

std::uint32_t FrameSender::KeptFrame::packets() const {
  return (static_cast<std::uint32_t>(payload.size()) + block() - 1) / block() + 2;
}

std::vector<std::uint8_t>& FrameSender::payload(std::size_t size) {
  const std::lock_guard lock(mutex_);
  KeptFrame& frame = kept_[next_];
  frame.id = 0;  // of no use to anybody while it is filled
  frame.payload.resize(size);
  return frame.payload;
}

void FrameSender::send(std::uint16_t id, TimeNs timestamp, const Exposing& exposing, double loss) {
  const std::lock_guard lock(mutex_);
  KeptFrame& frame = kept_[next_];
  next_ = (next_ + 1) % kept_.size();
  frame.id = id;
  frame.timestamp = timestamp;
  frame.exposing = exposing;
  sendPackets(frame, 0, frame.packets() - 1, loss);
}

void FrameSender::resend(std::uint16_t id, std::uint32_t first, std::uint32_t last, double loss) {
  const std::lock_guard lock(mutex_);
  const auto frame =
      std::find_if(kept_.begin(), kept_.end(), [&](const KeptFrame& f) { return f.id == id && id != 0; });
  if (frame == kept_.end() || first > last || first >= frame->packets()) return;
  last = std::min(last, frame->packets() - 1);
  resent_ += last - first + 1;
  sendPackets(*frame, first, last, loss);
}

std::uint64_t FrameSender::resent() const {
  const std::lock_guard lock(mutex_);
  return resent_;
}

void FrameSender::sendTestPacket(const Exposing& exposing) {
  socket_.send(std::vector<std::uint8_t>(exposing.packet_size - kUdpHeaders), exposing.listener);
}

void FrameSender::sendPackets(const KeptFrame& frame, std::uint32_t first, std::uint32_t last, double loss) {
  std::array<PacketHeader, kBatch> headers;
  std::array<std::array<iovec, 2>, kBatch> parts;
  std::array<mmsghdr, kBatch> messages;
  sockaddr_in to{};
  to.sin_family = AF_INET;
  to.sin_port = htons(frame.exposing.listener.port);
  to.sin_addr.s_addr = htonl(frame.exposing.listener.ip);
  const std::uint32_t type = frame.exposing.chunks ? kImageWithChunks : kImage;
  const unsigned batch = frame.exposing.packet_delay > 0 ? 1 : kBatch;
  unsigned count = 0;
  const auto flush = [&] {
    for (unsigned sent = 0; sent < count;) {
      const int done = sendmmsg(socket_.descriptor(), messages.data() + sent, count - sent, 0);
      if (done <= 0) break;
      sent += static_cast<unsigned>(done);
    }
    count = 0;
    if (frame.exposing.packet_delay <= 0) return;
    const timespec pause{0, static_cast<long>(frame.exposing.packet_delay % kNanosecondsPerSecond)};
    clock_nanosleep(CLOCK_MONOTONIC, 0, &pause, nullptr);
  };
  for (std::uint32_t i = first; i <= last; ++i) {
    if (loss > 0.0 && random_.uniform() < loss) continue;
    PacketHeader& header = headers[count];
    header.size = 0;
    const bool leader = i == 0, trailer = i == frame.packets() - 1;
    header.put(frame.id);
    header.put(std::uint32_t{leader ? kLeader : trailer ? kTrailer : kPayload} << 24 | i);
    iovec& part = parts[count][1];
    part = {};
    if (leader) {
      const auto time = static_cast<std::uint64_t>(frame.timestamp);
      for (const std::uint32_t word :
           {type, static_cast<std::uint32_t>(time >> 32), static_cast<std::uint32_t>(time), frame.exposing.format,
            static_cast<std::uint32_t>(frame.exposing.width), static_cast<std::uint32_t>(frame.exposing.height),
            static_cast<std::uint32_t>(frame.exposing.offset_x), static_cast<std::uint32_t>(frame.exposing.offset_y),
            0U})
        header.put(word);
    } else if (trailer) {
      header.put(type);
      header.put(static_cast<std::uint32_t>(frame.exposing.height));
      if (frame.exposing.chunks) {
        header.put(static_cast<std::uint32_t>(frame.payload.size()));
        header.put(0);  // they lie in every frame in the same way
      }
    } else {
      const std::size_t at = std::size_t{i - 1} * frame.block();
      part = {const_cast<std::uint8_t*>(frame.payload.data()) + at,
                 std::min<std::size_t>(frame.block(), frame.payload.size() - at)};
    }
    parts[count][0] = {header.bytes.data(), header.size};
    messages[count] = {};
    messages[count].msg_hdr = {&to, sizeof to, parts[count].data(), part.iov_len > 0 ? 2U : 1U, nullptr, 0, 0};
    if (++count == batch) flush();
  }
  if (count > 0) flush();
}

}  // namespace helical::gige
