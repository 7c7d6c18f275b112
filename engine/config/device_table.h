#pragma once

#include "engine/cameras/device_options.h"
#include "engine/config/toml_table.h"

namespace helical {

/// Reads `[camera.device]`. Throws as TomlTable.
void readDeviceOptions(TomlTable table, DeviceOptions& options);

}  // namespace helical
