#include "engine/transmitter/output_device.h"

#include <string>

#include "engine/base/error.h"
#include "engine/transmitter/crazyradio.h"
#include "engine/transmitter/loopback_device.h"
#include "engine/transmitter/mcc_analog_output.h"

namespace helical {

std::unique_ptr<Transmitter> openOutputDevice(const OutputSettings& settings) {
  const std::string device(settings.device.data());
  if (device == "loopback") return std::make_unique<LoopbackDevice>(settings.address.data());
  const std::string serial(settings.address.data());
  if (device == kMccDevice)
    return std::make_unique<MccAnalogOutput>(MccProtocol::wanted(serial), settings.channels, settings.trainer_input);
  if (device == kCrazyradioDevice)
    return std::make_unique<Crazyradio>(Crazyradio::wanted(serial), settings.radio, settings.channels);
  throw Error(ErrorKind::kInput, "there is no output device '" + device + "'", {},
              "use \"loopback\", \"mcc-usb-3100\" or \"crazyradio\"");
}

}  // namespace helical
