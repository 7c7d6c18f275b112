#pragma once

#include <string>
#include <vector>

#include "engine/config/rig_config.h"
#include "engine/session/image_recording.h"
#include "engine/simulator/virtual_rig.h"

namespace helical {

/// Values of command-line options with a form of their own. Each throws Error(kInput) that shows the form.

Occlusion parseOcclusion(const std::string& text, const RigConfig& rig);  ///< "2@13-25": camera, seconds
Bump parseBump(const std::string& text,
               const RigConfig& rig);  ///< "3@10:5,0.05": camera, seconds, degrees, metres
/// "2@8-11": camera, seconds; then ":0.01" for kLoss and kJitter, ":0.02,50" (seconds, millionths) for kClock.
ScheduledFault parseFault(const std::string& text, ScheduledFault::Kind kind, const std::string& option,
                          const RigConfig& rig);

/// "jpeg", "lossless@10", "2=off": of each camera; later ones change what earlier ones said.
std::vector<ImageRecording> parseImageRecordings(const std::vector<std::string>& texts, const RigConfig& rig);

}  // namespace helical
