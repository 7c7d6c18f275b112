#pragma once

#include <string>
#include <vector>

#include "engine/config/rig_config.h"
#include "engine/flight/flight_plan.h"
#include "engine/session/image_recording.h"
#include "engine/session/mcap_format.h"

namespace helical {

/// What a flight was made with: enough to build its flight loop again, to the last bit.
struct SessionSettings {
  std::string rig_text;   ///< the rig file as it was read
  std::string plan_text;  ///< the plan file
  RigConfig rig;          ///< what flew: the file and what the command line made of it
  FlightPlan plan;
  bool realtime = false;
  std::vector<ImageRecording> images;  ///< of each camera; none when empty
};

/// As files in a session: `rig.toml`, `plan.toml`, and `settings.json` with what differed from them.
std::vector<McapAttachment> toAttachments(const SessionSettings& settings);

/// Throws Error(kInput) naming `session` when something is missing or does not make sense.
SessionSettings fromAttachments(const std::vector<McapAttachment>& attachments, const std::string& session);

}  // namespace helical
