#include "engine/transmitter/output_device.h"

#include <string>

#include "engine/base/error.h"
#include "engine/transmitter/loopback_device.h"

namespace helical {

std::unique_ptr<Transmitter> openOutputDevice(const OutputSettings& settings) {
  const std::string device(settings.device.data());
  if (device == "loopback") return std::make_unique<LoopbackDevice>(settings.address.data());
  throw Error(ErrorKind::kInput, "there is no output device '" + device + "'", {}, "use \"loopback\"");
}

}  // namespace helical
