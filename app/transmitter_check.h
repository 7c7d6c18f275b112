#pragma once

#include "app/conversation.h"
#include "engine/transmitter/transmitter_options.h"

namespace helical {

/// Moves one stick after the other, and asks the operator whether it goes the right way; motors off. A stick that goes the
/// wrong way is turned round in `transmitter` if the operator wants so, and looked at again. False when the operator gives
/// up, or a stick cannot be mended here. Throws Error(kDevice) when the device is missing or lost.
bool lookAtDirections(Conversation& talk, TransmitterOptions& transmitter);

}  // namespace helical
