#include "engine/transmitter/crazyradio.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

namespace helical {
namespace {

// Vendor requests.
constexpr std::uint8_t kVendor = 0x40, kChannel = 0x01, kAddress = 0x02, kRate = 0x03, kPower = 0x04, kRetryDelay = 0x05,
                       kRetries = 0x06, kAcknowledge = 0x10, kCarrier = 0x20;
constexpr std::uint16_t kAckBytes = 0x80 | 32, kThreeRetries = 3;

// Packet headers: port, link bits, channel.
constexpr std::uint8_t headerOf(int port, int channel) {
  return static_cast<std::uint8_t>(port << 4 | 3 << 2 | channel);
}
constexpr std::uint8_t kSetPoint = headerOf(3, 0), kSupervisor = headerOf(9, 1);
constexpr std::uint8_t kArm = 0x01, kFeedWatchdog = 0x04;

constexpr TimeNs kFeedEvery = 200 * kNanosecondsPerMillisecond;
constexpr double kLeastThrust = 1000.0, kMostThrust = 60000.0;  // below, the firmware stops the motors
constexpr int kDrainMs = 2, kLongestDrain = 64;

template <class T>
void append(std::array<std::uint8_t, 15>& packet, std::size_t at, T value) {
  std::memcpy(packet.data() + at, &value, sizeof value);
}

}  // namespace

UsbWanted Crazyradio::wanted(const std::string& serial) {
  return {0x1915, {0x7777}, serial};
}

Crazyradio::Crazyradio(UsbWanted wanted, const RadioOptions& radio, const OutputChannels& channels)
    : UsbTransmitter(std::move(wanted)), radio_(radio), mapper_(channels) {}

TransmitterTrouble Crazyradio::begin(UsbDevice& device) {
  if (!device.hasOutEndpoint()) return TransmitterTrouble::kUnfit;
  mapper_ = ChannelMapper(mapper_.channels());
  acks_astray_ = true;
  armed_ = false;
  const std::uint16_t rate = radio_.rate_kbps == 250 ? 0 : radio_.rate_kbps == 1000 ? 1 : 2;
  const std::pair<std::uint8_t, std::uint16_t> settings[] = {
      {kRate, rate},
      {kChannel, static_cast<std::uint16_t>(radio_.channel)},
      {kCarrier, 0},
      {kPower, static_cast<std::uint16_t>(radio_.power)},
      {kRetries, kThreeRetries},
      {kRetryDelay, kAckBytes},
      {kAcknowledge, 1}};
  for (const auto& [request, value] : settings)
    if (const auto trouble = device.control(kVendor, request, value); trouble != TransmitterTrouble::kNone) return trouble;
  return device.control(kVendor, kAddress, 0, radio_.address);
}

/// An acknowledgement that was given up and came all the same would be taken for the next one's.
TransmitterTrouble Crazyradio::drain(UsbDevice& device) {
  for (int i = 0; i < kLongestDrain; ++i) {
    std::array<std::uint8_t, 64> astray;
    std::size_t count = 0;
    const auto trouble = device.read(astray, count, kDrainMs);
    if (trouble == TransmitterTrouble::kTimedOut) {
      acks_astray_ = false;
      return TransmitterTrouble::kNone;
    }
    if (trouble != TransmitterTrouble::kNone) return trouble;
  }
  return TransmitterTrouble::kFailed;
}

TransmitterTrouble Crazyradio::sendPacket(UsbDevice& device, std::span<const std::uint8_t> packet) {
  if (acks_astray_)
    if (const auto trouble = drain(device); trouble != TransmitterTrouble::kNone) return trouble;
  // Whatever goes wrong from here, it is not known whether an acknowledgement will come.
  acks_astray_ = true;
  if (const auto trouble = device.write(packet); trouble != TransmitterTrouble::kNone) return trouble;
  std::array<std::uint8_t, 64> answer{};
  std::size_t count = 0;
  if (const auto trouble = device.read(answer, count); trouble != TransmitterTrouble::kNone) return trouble;
  acks_astray_ = false;
  return count > 0 && (answer[0] & 1) != 0 ? TransmitterTrouble::kNone : TransmitterTrouble::kNotAcknowledged;
}

/// Newer firmware turns its motors only when it is told that it may; older firmware does not know the packet.
TransmitterTrouble Crazyradio::armWithRotors(UsbDevice& device, bool turn) {
  if (turn == armed_) return TransmitterTrouble::kNone;
  const auto trouble = sendPacket(device, std::array<std::uint8_t, 3>{kSupervisor, kArm, static_cast<std::uint8_t>(turn)});
  if (trouble == TransmitterTrouble::kNone) armed_ = turn;
  return trouble;
}

TransmitterTrouble Crazyradio::transmit(UsbDevice& device, const StickDemand& demand, TimeNs now, bool /*level*/) {
  double thrust = 0.0;
  float roll = 0.0f, pitch = 0.0f, yaw_rate = 0.0f;
  const auto values = mapper_.step(demand, now);
  for (std::size_t i = 0; i < values.size(); ++i) switch (mapper_.channels().all[i].axis) {
      case StickAxis::kRoll:
        roll = static_cast<float>(values[i]);
        break;
      case StickAxis::kPitch:
        pitch = static_cast<float>(values[i]);
        break;
      case StickAxis::kYaw:
        yaw_rate = static_cast<float>(values[i]);
        break;
      default:
        thrust = values[i];
    }
  if (thrust < kLeastThrust) thrust = 0.0;
  // Its own pitch is positive nose up, and in this packet yaw is positive to the right.
  std::array<std::uint8_t, 15> packet{kSetPoint};
  append(packet, 1, roll);
  append(packet, 5, -pitch);
  append(packet, 9, -yaw_rate);
  append(packet, 13, static_cast<std::uint16_t>(std::lround(std::min(thrust, kMostThrust))));
  // The set-point last: it is the newest that counts, and alone decides whether the rotors turn.
  TransmitterTrouble extra = armWithRotors(device, thrust > 0.0);
  if (extra == TransmitterTrouble::kNone && now - fed_at_ >= kFeedEvery) {
    extra = sendPacket(device, std::array<std::uint8_t, 2>{kSupervisor, kFeedWatchdog});
    if (extra == TransmitterTrouble::kNone) fed_at_ = now;
  }
  if (extra != TransmitterTrouble::kNone && extra != TransmitterTrouble::kNotAcknowledged) return extra;
  return sendPacket(device, packet);
}

}  // namespace helical
