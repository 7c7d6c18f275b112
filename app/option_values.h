#pragma once

#include <string>

#include "engine/config/rig_config.h"

namespace helical {

/// Values of command-line options with a form of their own. Each throws Error(kInput) that shows the form.

Occlusion parseOcclusion(const std::string& text, const RigConfig& rig);  ///< "2@13-25": camera, seconds
Bump parseBump(const std::string& text,
               const RigConfig& rig);  ///< "3@10:5,0.05": camera, seconds, degrees, metres

}  // namespace helical
