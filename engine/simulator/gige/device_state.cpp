#include "engine/simulator/gige/device_state.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdio>
#include <utility>

#include "engine/base/monotonic.h"
#include "engine/simulator/gige/description.h"
#include "engine/simulator/gige/pixel_formats.h"

namespace helical::gige {
namespace {

constexpr std::uint32_t kSmallestSide = 16;
constexpr double kHighestRate = 240.0;  // Hz, of the sensor
constexpr std::uint32_t kControlBits = 3;
constexpr std::uint32_t kFireTestPacket = 0x80000000;
constexpr TimeNs kTickFrequency = kNanosecondsPerSecond;
constexpr std::uint32_t kTriggeredByLine = 1, kTriggeredByAction = 2;  // 0: by software

struct RealFeature {
  std::uint32_t address;
  double low, high;
};
constexpr RealFeature kReals[] = {
    {kFrameRate, 1.0, kHighestRate},      {kExposureTime, 10.0, 100'000.0},     {kGain, 0.0, 24.0},
    {kBalanceRatio, 0.25, 4.0}, {kBalanceRatio + 8, 0.25, 4.0}, {kBalanceRatio + 16, 0.25, 4.0},
};

const RealFeature* realAt(std::uint32_t address) {
  const auto* found =
      std::find_if(std::begin(kReals), std::end(kReals), [&](const auto& r) { return r.address == address; });
  return found == std::end(kReals) ? nullptr : found;
}

}  // namespace

int bitsPerPixel(std::uint32_t format) {
  return isOffered(format) ? static_cast<int>(format >> 16 & 0xff) : 0;
}

DeviceState::DeviceState(const Identity& identity) : identity_(identity), memory_(deviceDescription()) {
  restart(0);
}

void DeviceState::restart(TimeNs now) {
  memory_ = RegisterMemory(deviceDescription());
  clock_.started = now;
  controller_ = {};
  taken_ = test_packet_ = reset_ = false;
  trigger_.reset();
  const std::pair<std::uint32_t, std::uint32_t> words[] = {
      {kVersion, 0x00010002},
      {kDeviceMode, 0x80000001},  // big-endian, UTF-8
      {kMacHigh, 0x000002fa},     // a locally administered address, told apart by the IP address
      {kMacLow, identity_.ip},
      {kSupportedIpConfiguration, 0x00000004},
      {kIpConfiguration, 0x00000004},
      {kCurrentIp, identity_.ip},
      {kSubnetMask, 0xff000000},
      {kInterfaces, 1},
      {kStreamChannels, 1},
      {kCapabilities, 0xc0000047},  // user name, serial number, action, resend, memory writes, concatenation
      {kHeartbeatTimeout, 3000},
      {kTickFrequencyLow, static_cast<std::uint32_t>(kTickFrequency)},
      {kStreamPacketSize, 1400},
      {kSensorWidth, static_cast<std::uint32_t>(identity_.width)},
      {kSensorHeight, static_cast<std::uint32_t>(identity_.height)},
      {kWidth, static_cast<std::uint32_t>(identity_.width)},
      {kHeight, static_cast<std::uint32_t>(identity_.height)},
      {kPixelFormat, kMono8},
  };
  for (const auto& [address, value] : words) memory_.setWord(address, value);
  const std::pair<std::uint32_t, std::string> texts[] = {
      {kManufacturer, "Helical"},          {kModel, "VirtualCamera"}, {kDeviceVersion, "1"},
      {kManufacturerInfo, "simulated field"}, {kSerial, identity_.serial}, {kUserName, identity_.user_name},
  };
  for (const auto& [address, text] : texts) memory_.setText(address, text.substr(0, 15));
  char url[64];
  std::snprintf(url, sizeof url, "Local:helical-camera.xml;%x;%zx", kRegisterMemory, deviceDescription().size());
  memory_.setText(kFirstUrl, url);
  memory_.setReal(kFrameRate, 30.0);
  memory_.setReal(kExposureTime, 2000.0);
  for (std::uint32_t colour = 0; colour < 3; ++colour) memory_.setReal(kBalanceRatio + 8 * colour, 1.0);
  derive();
}

void DeviceState::derive() {
  const auto bits = static_cast<std::uint32_t>(bitsPerPixel(memory_.word(kPixelFormat)));
  memory_.setWord(kPayloadSize, memory_.word(kWidth) * memory_.word(kHeight) * bits / 8 +
                                    (exposing().chunks ? kChunkBytes : 0));
  memory_.setReal(kHighestFrameRate, std::min(kHighestRate, 1e6 / memory_.real(kExposureTime)));
  memory_.setReal(kFrameRate, std::min(memory_.real(kFrameRate), memory_.real(kHighestFrameRate)));
  memory_.setWord(kPtpStatus, memory_.word(kPtpEnable) & 1);
}

Status DeviceState::read(std::uint32_t address, std::uint32_t& value) const {
  if (address % 4 != 0 || !memory_.holds(address, 4)) return Status::kInvalidAddress;
  value = memory_.word(address);
  return Status::kSuccess;
}

Status DeviceState::read(std::uint32_t address, std::uint32_t size, std::span<const std::uint8_t>& bytes) const {
  if (!memory_.holds(address, size)) return Status::kInvalidAddress;
  bytes = memory_.bytes(address, size);
  return Status::kSuccess;
}

bool DeviceState::mayWrite(const Peer& from) const {
  return !taken_ && (!controlled() || from == controller_);
}

void DeviceState::heard(const Peer& from, TimeNs now) {
  if (controlled() && !taken_ && from == controller_) heard_ = now;
}

void DeviceState::expire(TimeNs now) {
  const TimeNs timeout = TimeNs{memory_.word(kHeartbeatTimeout)} * kNanosecondsPerMillisecond;
  if (controlled() && !taken_ && now - heard_ > timeout) release();
}

void DeviceState::release() {
  controller_ = {};
  for (const auto address : {kControlPrivilege, kAcquisition, kStreamPort, kTransportLocked}) memory_.setWord(address, 0);
}

void DeviceState::take(bool taken) {
  if (taken == taken_) return;
  release();
  taken_ = taken;
  memory_.setWord(kControlPrivilege, taken ? 2 : 0);
}

Status DeviceState::write(std::uint32_t address, std::uint32_t value, const Peer& from, TimeNs now) {
  if (!mayWrite(from)) return Status::kAccessDenied;
  if (address % 4 != 0 || address >= kRegisterMemory) return Status::kInvalidAddress;
  switch (address) {
    case kControlPrivilege:
      if ((value & kControlBits) == 0) {
        release();
        return Status::kSuccess;
      }
      controller_ = from;
      heard_ = now;
      break;
    case kTimestampControl:
      if ((value & 2) != 0) {
        const auto time = static_cast<std::uint64_t>(deviceTime(now));
        memory_.setWord(kTimestampHigh, static_cast<std::uint32_t>(time >> 32));
        memory_.setWord(kTimestampLow, static_cast<std::uint32_t>(time));
      }
      return Status::kSuccess;
    case kStreamPacketSize:
      test_packet_ = test_packet_ || (value & kFireTestPacket) != 0;
      value &= ~kFireTestPacket;
      break;
    case kHeartbeatTimeout:
      if (value < 500 || value > 60'000) return Status::kInvalidParameter;
      break;
    default:
      break;
  }
  if (address == kTriggerSoftware) {
    if (value != 0 && memory_.word(kTriggerSource) == 0) trigger_ = now;
    return Status::kSuccess;
  }
  if (address >= kFeatures && address < kFeaturesEnd) return writeFeature(address, value);
  if (address < kHeartbeatTimeout && address != kUserName && address != kStreamChannels) return Status::kWriteProtected;
  memory_.setWord(address, value);
  return Status::kSuccess;
}

Status DeviceState::writeFeature(std::uint32_t address, std::uint32_t value) {
  const std::uint32_t width = memory_.word(kWidth), height = memory_.word(kHeight);
  const std::uint32_t sensor_width = memory_.word(kSensorWidth), sensor_height = memory_.word(kSensorHeight);
  const bool even = value % 2 == 0;
  const auto size_fits = [&](std::uint32_t sensor, std::uint32_t offset) {
    return even && value >= kSmallestSide && value <= sensor - offset;
  };
  bool fits = true;
  switch (address) {
    case kWidth:
      fits = size_fits(sensor_width, memory_.word(kOffsetX));
      break;
    case kHeight:
      fits = size_fits(sensor_height, memory_.word(kOffsetY));
      break;
    case kOffsetX:
      fits = even && value <= sensor_width - width;
      break;
    case kOffsetY:
      fits = even && value <= sensor_height - height;
      break;
    case kPixelFormat:
      fits = isOffered(value);
      break;
    case kBalanceSelector:
    case kTriggerSource:
      fits = value <= 2;
      break;
    case kSensorWidth:
    case kSensorHeight:
    case kPayloadSize:
    case kPtpStatus:
      return Status::kWriteProtected;
    case kDeviceReset:
      reset_ = value != 0;
      return Status::kSuccess;
    default:
      break;
  }
  if (!fits) return Status::kInvalidParameter;
  memory_.setWord(address, value);
  derive();
  return Status::kSuccess;
}

Status DeviceState::writeReal(std::uint32_t address, double value) {
  const RealFeature& feature = *realAt(address);
  double high = feature.high;
  if (address == kFrameRate) high = std::min(high, memory_.real(kHighestFrameRate));
  if (!(value >= feature.low && value <= high * (1.0 + 1e-9))) return Status::kInvalidParameter;
  memory_.setReal(address, value);
  derive();
  return Status::kSuccess;
}

Status DeviceState::write(std::uint32_t address, std::span<const std::uint8_t> bytes, const Peer& from,
                          TimeNs now) {
  if (!mayWrite(from)) return Status::kAccessDenied;
  if (!memory_.holds(address, static_cast<std::uint32_t>(bytes.size())) || address >= kRegisterMemory)
    return Status::kInvalidAddress;
  std::uint64_t value = 0;
  for (const std::uint8_t byte : bytes) value = value << 8 | byte;
  if (bytes.size() == 8 && realAt(address) != nullptr) return writeReal(address, std::bit_cast<double>(value));
  if (bytes.size() == 4) return write(address, static_cast<std::uint32_t>(value), from, now);
  if (address < kUserName || address + bytes.size() > kUserName + 16) return Status::kWriteProtected;
  memory_.setBytes(address, bytes);
  return Status::kSuccess;
}

Exposing DeviceState::exposing() const {
  Exposing e;
  e.listener = {memory_.word(kStreamDestination), static_cast<std::uint16_t>(memory_.word(kStreamPort))};
  e.acquiring = memory_.word(kAcquisition) != 0 && e.listener.port != 0 && controlled() && !taken_;
  e.triggered = memory_.word(kTriggerMode) != 0;
  e.chunks = memory_.word(kChunkMode) != 0 && memory_.word(kChunkEnable) != 0;
  e.rate_hz = memory_.real(kFrameRate);
  e.exposure_us = memory_.real(kExposureTime);
  e.gain = std::pow(10.0, memory_.real(kGain) / 20.0);
  for (std::uint32_t colour = 0; colour < 3; ++colour) e.balance[colour] = memory_.real(kBalanceRatio + 8 * colour);
  e.format = memory_.word(kPixelFormat);
  e.width = static_cast<int>(memory_.word(kWidth));
  e.height = static_cast<int>(memory_.word(kHeight));
  e.offset_x = static_cast<int>(memory_.word(kOffsetX));
  e.offset_y = static_cast<int>(memory_.word(kOffsetY));
  e.packet_size = std::clamp(memory_.word(kStreamPacketSize) & 0xffffU, 220U, 16'384U);
  e.packet_delay = memory_.word(kStreamPacketDelay);
  return e;
}

bool DeviceState::takeTestPacketOrder() {
  return std::exchange(test_packet_, false);
}
bool DeviceState::takeResetOrder() {
  return std::exchange(reset_, false);
}

bool DeviceState::actionIsMine(std::uint32_t device_key, std::uint32_t group_key, std::uint32_t group_mask) const {
  return memory_.word(kTriggerSource) == kTriggeredByAction && device_key == memory_.word(kActionDeviceKey) &&
         group_key == memory_.word(kActionGroupKey) && (group_mask & memory_.word(kActionGroupMask)) != 0;
}

void DeviceState::triggerAt(TimeNs when, TimeNs now) {
  trigger_ = memory_.word(kPtpEnable) != 0 ? now + when - deviceTime(now) : clock_.host(when);
}

void DeviceState::pulse(TimeNs now) {
  if (memory_.word(kTriggerSource) == kTriggeredByLine) trigger_ = now;
}

TimeNs DeviceState::deviceTime(TimeNs now) const {
  return memory_.word(kPtpEnable) != 0 ? worldNow() + now - monotonicNow() : clock_.device(now);
}

}  // namespace helical::gige
