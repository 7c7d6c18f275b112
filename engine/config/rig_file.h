#pragma once

#include <filesystem>
#include <string_view>

#include "engine/config/rig_config.h"

namespace helical {

/// Loads a rig file (TOML; the format is in resources/rigs/README.md). Throws Error(kInput) with file, line,
/// what and cure for anything missing, of a wrong type, out of range, unknown or double.
RigConfig loadRig(const std::filesystem::path& file);

/// The same from text; `name` stands for the file in messages.
RigConfig parseRig(std::string_view toml, const std::string& name);

}  // namespace helical
