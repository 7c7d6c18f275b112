#pragma once

namespace helical {

/// What the program helical-output does, with the shared memory behind `descriptor`: puts the newest demand
/// out at the device's rate, or what OutputGuard makes of it when it is old; reports; and ends when the
/// ground station says so or is gone, not before the sticks are at rest. Throws Error.
void runOutput(int descriptor);

}  // namespace helical
