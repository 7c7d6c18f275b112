#pragma once

#include <string>

namespace helical {

enum class ProbeAnswer { kSilent, kFree, kControlled };

/// Asks a GigE Vision camera whether it is there and whether somebody controls it, within `timeout_ms`. Needs no
/// control and costs one datagram each way; Aravis' own attempt to open a dead camera blocks for seconds.
ProbeAnswer probe(const std::string& ip, int timeout_ms);

bool isIpAddress(const std::string& text);

}  // namespace helical
