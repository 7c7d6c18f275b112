#include "tests/transmitter/emulated_device.h"

#include <algorithm>
#include <cerrno>
#include <cstring>

namespace helical {

UsbReply UsbReply::stall() {
  return {-EPIPE, {}, false};
}

UsbReply EmulatedDevice::control(const UsbSetup& /*setup*/, const UsbBytes& /*data*/) {
  return UsbReply::stall();
}

UsbReply EmulatedDevice::text(const UsbSetup& setup, const std::vector<const char*>& texts) {
  const std::size_t index = setup.value & 0xFF;
  UsbBytes bytes{4, 3, 9, 4};  // of index 0: the languages
  if (index > texts.size()) return UsbReply::stall();
  if (index > 0) {
    const char* text = texts[index - 1];
    bytes = {static_cast<std::uint8_t>(2 + 2 * std::strlen(text)), 3};
    for (; *text != '\0'; ++text) bytes.insert(bytes.end(), {static_cast<std::uint8_t>(*text), 0});
  }
  bytes.resize(std::min<std::size_t>(bytes.size(), setup.length));
  return UsbReply::of(std::move(bytes));
}

}  // namespace helical
