#pragma once

#include <optional>

#include "engine/base/time.h"

namespace helical {

/// Time since the kernel started this process, to about 10 ms; nothing where /proc does not tell.
std::optional<TimeNs> sinceProcessStart();

}  // namespace helical
