#include "engine/transmitter/mcc_analog_output.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

namespace helical {
namespace {

// Report ids.
constexpr std::uint8_t kConfigureBit = 0x02, kGetBit = 0x05, kPutBit = 0x06, kPut = 0x14, kSync = 0x15, kConfigure = 0x1C,
                       kReadMemory = 0x30, kSetSync = 0x43, kStatus = 0x44;
constexpr std::uint8_t kSetReport = 0x09, kToInterface = 0x21;
constexpr int kUnrelatedReports = 8;  // of an earlier program, perhaps, before the one that is waited for
constexpr double kFullScale = 10.0;   // V

/// A report with its id in front, to the endpoint or, where there is none, as a request.
TransmitterTrouble sendReport(UsbDevice& device, std::span<const std::uint8_t> report) {
  if (device.hasOutEndpoint()) return device.write(report);
  return device.control(kToInterface, kSetReport, static_cast<std::uint16_t>(0x0200 | report[0]), report);
}

template <std::size_t N>
TransmitterTrouble sendBytes(UsbDevice& device, const std::array<std::uint8_t, N>& report) {
  return sendReport(device, report);
}

TransmitterTrouble awaitReport(UsbDevice& device, std::uint8_t id, std::size_t least, std::array<std::uint8_t, 64>& report) {
  for (int i = 0; i < kUnrelatedReports; ++i) {
    std::size_t count = 0;
    if (const auto trouble = device.read(report, count); trouble != TransmitterTrouble::kNone) return trouble;
    if (count >= least && report[0] == id) return TransmitterTrouble::kNone;
  }
  return TransmitterTrouble::kSelfTestFailed;
}

}  // namespace

UsbWanted MccProtocol::wanted(const std::string& serial) {
  return {0x09DB, {0x009A, 0x009B, 0x009C, 0x009D, 0x009E, 0x009F, 0x00A2, 0x00A3, 0x00A4}, serial};
}

int MccProtocol::outputsOf(std::uint16_t product) {
  switch (product) {
    case 0x009A:
    case 0x009B:
    case 0x00A2:
      return 4;
    case 0x009C:
    case 0x009D:
    case 0x00A3:
      return 8;
    default:
      return 16;
  }
}

TransmitterTrouble MccProtocol::readCalibration(UsbDevice& device, int output) {
  Output& o = outputs_[static_cast<std::size_t>(output)];
  const int address = 0x100 + 0x10 * output + (o.bipolar ? 8 : 0);
  const std::array<std::uint8_t, 5> request{kReadMemory, static_cast<std::uint8_t>(address & 0xFF),
                                            static_cast<std::uint8_t>(address >> 8), 0, 8};
  if (const auto trouble = sendBytes(device, request); trouble != TransmitterTrouble::kNone) return trouble;
  std::array<std::uint8_t, 64> report{};
  if (const auto trouble = awaitReport(device, kReadMemory, 9, report); trouble != TransmitterTrouble::kNone) return trouble;
  std::memcpy(&o.slope, &report[1], 4);
  std::memcpy(&o.offset, &report[5], 4);
  // A device that was never calibrated has all bits set there.
  const bool plausible = std::isfinite(o.slope) && std::isfinite(o.offset) && o.slope > 0.9f && o.slope < 1.1f &&
                         std::abs(o.offset) < 2000.0f;
  return plausible ? TransmitterTrouble::kNone : TransmitterTrouble::kSelfTestFailed;
}

/// So that it acts on its own sync reports. Which of the two values means master, the sources do not agree about: it is
/// asked. One that can do neither takes each voltage as it comes.
TransmitterTrouble MccProtocol::becomeMaster(UsbDevice& device) {
  synchronous_ = false;
  for (const std::uint8_t master : {std::uint8_t{0}, std::uint8_t{1}}) {
    std::array<std::uint8_t, 64> report{};
    for (const auto& trouble : {sendBytes(device, std::array{kSetSync, master}), sendBytes(device, std::array{kStatus}),
                                awaitReport(device, kStatus, 2, report)})
      if (trouble != TransmitterTrouble::kNone) return trouble;
    if ((report[1] & 1) != 0) {
      synchronous_ = true;
      break;
    }
  }
  return TransmitterTrouble::kNone;
}

TransmitterTrouble MccProtocol::begin(UsbDevice& device, const OutputChannels& channels) {
  const int outputs = outputsOf(device.product());
  for (const OutputChannel& channel : channels.span()) {
    if (channel.output >= outputs) return TransmitterTrouble::kUnfit;
    Output& output = outputs_[static_cast<std::size_t>(channel.output)];
    output.bipolar = channel.minimum < 0.0;
    const std::array<std::uint8_t, 3> configure{kConfigure, static_cast<std::uint8_t>(channel.output),
                                                static_cast<std::uint8_t>(output.bipolar ? 1 : 0)};
    if (const auto trouble = sendBytes(device, configure); trouble != TransmitterTrouble::kNone) return trouble;
    if (const auto trouble = readCalibration(device, channel.output); trouble != TransmitterTrouble::kNone) return trouble;
  }
  if (const auto trouble = sendBytes(device, std::array<std::uint8_t, 3>{kConfigureBit, 0, 0});
      trouble != TransmitterTrouble::kNone)
    return trouble;
  return becomeMaster(device);
}

std::uint16_t MccProtocol::codeOf(int output, double volts) const {
  const Output& o = outputs_[static_cast<std::size_t>(output)];
  const double ideal = o.bipolar ? volts / kFullScale * 32768.0 + 32768.0 : volts / kFullScale * 65536.0;
  const double code = static_cast<double>(o.slope) * ideal + static_cast<double>(o.offset);
  return static_cast<std::uint16_t>(std::lround(std::clamp(code, 0.0, 65535.0)));
}

TransmitterTrouble MccProtocol::put(UsbDevice& device, const OutputChannels& channels, std::span<const double> volts) const {
  for (std::size_t i = 0; i < channels.span().size(); ++i) {
    const int output = channels.all[i].output;
    const std::uint16_t code = codeOf(output, volts[i]);
    const std::array<std::uint8_t, 5> report{kPut, static_cast<std::uint8_t>(output), static_cast<std::uint8_t>(code & 0xFF),
                                             static_cast<std::uint8_t>(code >> 8),
                                             static_cast<std::uint8_t>(synchronous_ ? 1 : 0)};
    if (const auto trouble = sendBytes(device, report); trouble != TransmitterTrouble::kNone) return trouble;
  }
  if (!synchronous_ || channels.count == 0) return TransmitterTrouble::kNone;
  return sendBytes(device, std::array{kSync});
}

TransmitterTrouble MccProtocol::putBit(UsbDevice& device, bool level) {
  return sendBytes(device, std::array<std::uint8_t, 3>{kPutBit, 0, static_cast<std::uint8_t>(level ? 1 : 0)});
}

TransmitterTrouble MccProtocol::configureInput(UsbDevice& device, int bit) {
  return sendBytes(device, std::array<std::uint8_t, 3>{kConfigureBit, static_cast<std::uint8_t>(bit), 1});
}

TransmitterTrouble MccProtocol::getBit(UsbDevice& device, int bit, bool& level) {
  const std::array<std::uint8_t, 2> request{kGetBit, static_cast<std::uint8_t>(bit)};
  if (const auto trouble = sendBytes(device, request); trouble != TransmitterTrouble::kNone) return trouble;
  std::array<std::uint8_t, 64> report{};
  const auto trouble = awaitReport(device, kGetBit, 2, report);
  level = report[1] != 0;
  return trouble;
}

MccAnalogOutput::MccAnalogOutput(UsbWanted wanted, const OutputChannels& channels, int trainer_input)
    : UsbTransmitter(std::move(wanted)), mapper_(channels), trainer_input_(trainer_input) {}

TransmitterTrouble MccAnalogOutput::begin(UsbDevice& device) {
  mapper_ = ChannelMapper(mapper_.channels());
  const auto trouble = protocol_.begin(device, mapper_.channels());
  if (trouble != TransmitterTrouble::kNone || trainer_input_ < 0) return trouble;
  return MccProtocol::configureInput(device, trainer_input_);
}

TransmitterTrouble MccAnalogOutput::transmit(UsbDevice& device, const StickDemand& demand, TimeNs now, bool level) {
  auto trouble = protocol_.put(device, mapper_.channels(), mapper_.step(demand, now));
  if (trouble == TransmitterTrouble::kNone) trouble = MccProtocol::putBit(device, level);
  if (trouble != TransmitterTrouble::kNone || trainer_input_ < 0) return trouble;
  bool pilot = true;
  trouble = MccProtocol::getBit(device, trainer_input_, pilot);
  tellPilotFlies(pilot);
  return trouble;
}

}  // namespace helical
