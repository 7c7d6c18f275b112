#include "tests/transmitter/emulated_crazyradio.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace helical {

UsbBytes EmulatedCrazyradio::descriptors() const {
  return {18, 1, 0, 2, 0, 0,    0,    64,   0x15, 0x19, 0x77, 0x77, 0x55, 0x99, 1, 2,    3, 1,    9, 2,
          32, 0, 1, 1, 0, 0x80, 50,   9,    4,    0,    0,    2,    0xFF, 0xFF, 0, 0,    7, 5,    0x81, 2,
          64, 0, 0, 7, 5, 0x01, 2,    64,   0,    0};
}

UsbReply EmulatedCrazyradio::control(const UsbSetup& setup, const UsbBytes& data) {
  if (setup.type == 0x80 && setup.request == 6 && setup.value >> 8 == 3)
    return text(setup, {"Bitcraze", "Crazyradio PA USB Dongle", "AB0123"});
  const bool known = (setup.request >= 1 && setup.request <= 6) || setup.request == 0x10 || setup.request == 0x20;
  if (setup.type != 0x40 || !known) return UsbReply::stall();
  settings[setup.request] = setup.value;
  if (setup.request == 2) address = data;
  return {};
}

UsbReply EmulatedCrazyradio::out(std::uint8_t endpoint, const UsbBytes& data) {
  if (endpoint != 0x01 || data.empty() || data.size() > 32) return UsbReply::stall();
  packets.push_back(data);
  const UsbBytes answer = hears ? UsbBytes{0x01, 0xF7} : UsbBytes{0x30};
  (late_answers > 0 ? held_ : answers_).push_back(answer);
  if (late_answers > 0) --late_answers;
  return {};
}

void EmulatedCrazyradio::release() {
  const std::lock_guard lock(mutex);
  std::move(held_.begin(), held_.end(), std::back_inserter(answers_));
  held_.clear();
}

UsbReply EmulatedCrazyradio::in(std::uint8_t /*endpoint*/) {
  if (answers_.empty()) return UsbReply::later();
  UsbBytes answer = std::move(answers_.front());
  answers_.pop_front();
  return UsbReply::of(std::move(answer));
}

std::vector<UsbBytes> EmulatedCrazyradio::packetsOf(std::uint8_t first) const {
  std::vector<UsbBytes> those;
  std::copy_if(packets.begin(), packets.end(), std::back_inserter(those), [&](const auto& p) { return p[0] == first; });
  return those;
}

}  // namespace helical
