#include "tests/transmitter/emulated_mcc.h"

#include <cstring>
#include <utility>

namespace helical {

EmulatedMcc::EmulatedMcc(std::string serial, std::uint16_t product, bool out_endpoint)
    : serial_(std::move(serial)), product_(product), out_endpoint_(out_endpoint) {
  latched_.fill(-1);
}

UsbBytes EmulatedMcc::descriptors() const {
  const auto low = static_cast<std::uint8_t>(product_ & 0xFF), high = static_cast<std::uint8_t>(product_ >> 8);
  const std::uint8_t ends = out_endpoint_ ? 2 : 1, length = out_endpoint_ ? 41 : 34;
  UsbBytes bytes{18, 1,    0, 2, 0, 0, 0, 64, 0xDB, 0x09, low, high, 0, 1,    1, 2,    3, 1,  9, 2, length,
                 0,  1,    1, 0, 0x80, 250, 9, 4, 0, 0, ends, 3, 0, 0, 0, 9,  0x21, 0x11, 1, 0, 1, 0x22,
                 64, 0,    7, 5, 0x81, 3, 64, 0, 1, 7, 5, 0x02, 3, 64, 0, 1};
  if (!out_endpoint_) bytes.resize(bytes.size() - 7);
  return bytes;
}

// No two outputs alike; the code that gives a voltage is slope * ideal + offset.
float EmulatedMcc::slopeOf(std::size_t output, bool bipolar) const {
  return 0.995f + 0.0013f * static_cast<float>(output) + (bipolar ? 0.002f : 0.0f);
}
float EmulatedMcc::offsetOf(std::size_t output, bool bipolar) const {
  return 12.0f - 7.0f * static_cast<float>(output) + (bipolar ? 31.0f : 0.0f);
}

void EmulatedMcc::convert(std::size_t output, int code) {
  const bool bipolar = bipolar_[output];
  const double ideal = (code - static_cast<double>(offsetOf(output, bipolar))) / static_cast<double>(slopeOf(output, bipolar));
  volts_[output] = bipolar ? (ideal - 32768.0) / 32768.0 * 10.0 : ideal / 65536.0 * 10.0;
  ++writes;
}

void EmulatedMcc::readMemory(int address, int count) {
  std::array<std::uint8_t, 0x200> memory;
  memory.fill(0xFF);
  for (std::size_t output = 0; output < 16 && calibrated; ++output)
    for (const bool bipolar : {false, true}) {
      const std::size_t at = 0x100 + 0x10 * output + (bipolar ? 8 : 0);
      const float slope = slopeOf(output, bipolar), offset = offsetOf(output, bipolar);
      std::memcpy(&memory[at], &slope, 4);
      std::memcpy(&memory[at + 4], &offset, 4);
    }
  UsbBytes reply{0x30};
  for (int i = 0; i < count; ++i) reply.push_back(memory[static_cast<std::size_t>(address + i) % memory.size()]);
  replies_.push_back(std::move(reply));
}

UsbReply EmulatedMcc::report(const UsbBytes& r) {
  if (hangs > 0) {
    --hangs;
    return UsbReply::later();
  }
  if (stalls > 0) {
    --stalls;
    return UsbReply::stall();
  }
  reports.push_back(r);
  const std::size_t output = r.size() > 1 ? r[1] % 16U : 0;
  switch (r.at(0)) {
    case 0x02:
      if (r.at(1) == 0) bit_drives = r.at(2) == 0;
      if (r.at(1) == 3) input_ = r.at(2) == 1;
      break;
    case 0x05:
      replies_.push_back({0x05, static_cast<std::uint8_t>(r.at(1) == 3 && input_ && trainer ? 1 : 0)});
      break;
    case 0x06:
      if (bit_drives && bit_ != (r.at(2) != 0)) ++toggles;
      bit_ = r.at(2) != 0;
      break;
    case 0x14:
      if (r.at(4) != 0) {
        latched_[output] = r.at(2) | r.at(3) << 8;
      } else {
        was_torn = true;
        convert(output, r.at(2) | r.at(3) << 8);
      }
      break;
    case 0x15:
      for (std::size_t i = 0; i < latched_.size() && master_; ++i)
        if (const int code = std::exchange(latched_[i], -1); code >= 0) convert(i, code);
      break;
    case 0x1C:
      bipolar_[output] = r.at(2) == 1;
      volts_[output] = 0.0;
      break;
    case 0x30:
      readMemory(r.at(1) | r.at(2) << 8, r.at(4));
      break;
    case 0x43:
      master_ = r.at(1) == master_value;
      break;
    case 0x44:
      replies_.push_back({0x44, static_cast<std::uint8_t>(master_ ? 1 : 0)});
      break;
    default:
      return UsbReply::stall();
  }
  return {};
}

UsbReply EmulatedMcc::out(std::uint8_t endpoint, const UsbBytes& data) {
  return endpoint == 0x02 && out_endpoint_ ? report(data) : UsbReply::stall();
}

UsbReply EmulatedMcc::control(const UsbSetup& setup, const UsbBytes& data) {
  if (setup.type == 0x80 && setup.request == 6 && setup.value >> 8 == 3)
    return text(setup, {"MCC", "USB-3103", serial_.c_str()});
  // A request to put out a report, with its id in the value.
  if (setup.type == 0x21 && setup.request == 9 && !data.empty() && setup.value == (0x0200 | data[0])) return report(data);
  return UsbReply::stall();
}

UsbReply EmulatedMcc::in(std::uint8_t /*endpoint*/) {
  if (replies_.empty()) return UsbReply::later();
  UsbBytes reply = std::move(replies_.front());
  replies_.pop_front();
  return UsbReply::of(std::move(reply));
}

}  // namespace helical
