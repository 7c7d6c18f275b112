#pragma once

#include <optional>

#include "app/conversation.h"
#include "engine/transmitter/transmitter_options.h"

namespace helical {

/// Measures the channels of a USB transmitter with the operator: at an analogue output by trying voltages. Nothing when the
/// operator gives up. Throws Error(kDevice) when the device is missing or lost.
std::optional<OutputChannels> measureChannels(Conversation& talk, const TransmitterOptions& transmitter);

}  // namespace helical
