#pragma once

#include "engine/base/time.h"

namespace helical {

/// CLOCK_MONOTONIC as the machine has it, not counted from anything of ours: what devices' threads stamp with, and
/// what processes on one machine share.
TimeNs monotonicNow();
/// CLOCK_REALTIME: the world's time, which PTP keeps; it may jump.
TimeNs worldNow();
/// Returns at `time` or later; at once if it has passed.
void sleepUntilMonotonic(TimeNs time);

}  // namespace helical
