#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace helical::gige {

/// Addresses that GigE Vision gives to every device's registers.
inline constexpr std::uint32_t kVersion = 0x0000;
inline constexpr std::uint32_t kDeviceMode = 0x0004;
inline constexpr std::uint32_t kMacHigh = 0x0008;
inline constexpr std::uint32_t kMacLow = 0x000c;
inline constexpr std::uint32_t kSupportedIpConfiguration = 0x0010;
inline constexpr std::uint32_t kIpConfiguration = 0x0014;
inline constexpr std::uint32_t kCurrentIp = 0x0024;
inline constexpr std::uint32_t kSubnetMask = 0x0034;
inline constexpr std::uint32_t kManufacturer = 0x0048;  ///< 32 bytes
inline constexpr std::uint32_t kModel = 0x0068;         ///< 32 bytes
inline constexpr std::uint32_t kDeviceVersion = 0x0088;  ///< 32 bytes
inline constexpr std::uint32_t kManufacturerInfo = 0x00a8;  ///< 48 bytes
inline constexpr std::uint32_t kSerial = 0x00d8;            ///< 16 bytes
inline constexpr std::uint32_t kUserName = 0x00e8;          ///< 16 bytes
inline constexpr std::uint32_t kFirstUrl = 0x0200;          ///< 512 bytes
inline constexpr std::uint32_t kInterfaces = 0x0600;
inline constexpr std::uint32_t kStreamChannels = 0x0904;
inline constexpr std::uint32_t kCapabilities = 0x0934;
inline constexpr std::uint32_t kHeartbeatTimeout = 0x0938;  ///< ms
inline constexpr std::uint32_t kTickFrequencyHigh = 0x093c;
inline constexpr std::uint32_t kTickFrequencyLow = 0x0940;
inline constexpr std::uint32_t kTimestampControl = 0x0944;
inline constexpr std::uint32_t kTimestampHigh = 0x0948;
inline constexpr std::uint32_t kTimestampLow = 0x094c;
inline constexpr std::uint32_t kControlPrivilege = 0x0a00;
inline constexpr std::uint32_t kStreamPort = 0x0d00;
inline constexpr std::uint32_t kStreamPacketSize = 0x0d04;
inline constexpr std::uint32_t kStreamPacketDelay = 0x0d08;  ///< ticks
inline constexpr std::uint32_t kStreamDestination = 0x0d18;

/// Addresses of the virtual camera's own features, as its description tells them.
inline constexpr std::uint32_t kFeatures = 0x2000;
inline constexpr std::uint32_t kWidth = 0x2000;
inline constexpr std::uint32_t kHeight = 0x2004;
inline constexpr std::uint32_t kOffsetX = 0x2008;
inline constexpr std::uint32_t kOffsetY = 0x200c;
inline constexpr std::uint32_t kSensorWidth = 0x2010;
inline constexpr std::uint32_t kSensorHeight = 0x2014;
inline constexpr std::uint32_t kPixelFormat = 0x2018;
inline constexpr std::uint32_t kPayloadSize = 0x201c;
inline constexpr std::uint32_t kAcquisitionMode = 0x2020;
inline constexpr std::uint32_t kAcquisition = 0x2024;
inline constexpr std::uint32_t kFrameRate = 0x2030;         ///< double
inline constexpr std::uint32_t kHighestFrameRate = 0x2038;  ///< double
inline constexpr std::uint32_t kExposureTime = 0x2040;      ///< double, us
inline constexpr std::uint32_t kGain = 0x2048;              ///< double, dB
inline constexpr std::uint32_t kBalanceRatio = 0x2050;      ///< double, of red, green, blue
inline constexpr std::uint32_t kBalanceSelector = 0x2070;   ///< 0 red, 1 green, 2 blue
inline constexpr std::uint32_t kTriggerMode = 0x2074;
inline constexpr std::uint32_t kTriggerSource = 0x2078;  ///< 0 software, 1 line 1, 2 action 1
inline constexpr std::uint32_t kTriggerSoftware = 0x207c;
inline constexpr std::uint32_t kTransportLocked = 0x2080;
inline constexpr std::uint32_t kPtpEnable = 0x2084;
inline constexpr std::uint32_t kPtpStatus = 0x2088;
inline constexpr std::uint32_t kDeviceReset = 0x208c;
inline constexpr std::uint32_t kActionDeviceKey = 0x2090;
inline constexpr std::uint32_t kActionGroupKey = 0x2094;
inline constexpr std::uint32_t kActionGroupMask = 0x2098;
inline constexpr std::uint32_t kChunkMode = 0x209c;
inline constexpr std::uint32_t kChunkEnable = 0x20a0;  ///< of the timestamp
inline constexpr std::uint32_t kFeaturesEnd = 0x2100;

inline constexpr std::uint32_t kRegisterMemory = 0x4000;  ///< bytes; the description stands behind them

/// A device's memory: registers in network byte order, behind them the XML that describes them. Plain memory: what
/// a write means is its owner's business. One thread at a time.
class RegisterMemory {
 public:
  explicit RegisterMemory(std::string_view description);

  bool holds(std::uint32_t address, std::uint32_t size) const { return address + std::uint64_t{size} <= bytes_.size(); }
  std::uint32_t word(std::uint32_t address) const;
  void setWord(std::uint32_t address, std::uint32_t value);
  double real(std::uint32_t address) const;
  void setReal(std::uint32_t address, double value);
  void setText(std::uint32_t address, std::string_view text);
  std::span<const std::uint8_t> bytes(std::uint32_t address, std::uint32_t size) const;
  void setBytes(std::uint32_t address, std::span<const std::uint8_t> bytes);

 private:
  std::vector<std::uint8_t> bytes_;
};

}  // namespace helical::gige
