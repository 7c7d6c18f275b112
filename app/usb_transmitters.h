#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "engine/cameras/machine_check.h"
#include "engine/config/rig_config.h"

namespace helical {

/// USB transmitters that are plugged in, for `helical devices`: [{kind, name, serial, trouble}], and in words.
nlohmann::json usbTransmittersJson();
std::string usbTransmittersText();

/// For `helical doctor`: whether the udev rules are installed on the machine at `root`, what is wrong with what is plugged
/// in, and whether the rig's device is there. `rig` may be null. Sets `missing` when that device is not to be had.
std::vector<Finding> checkUsbTransmitters(const std::filesystem::path& root, const RigConfig* rig, bool& missing);

}  // namespace helical
