#pragma once

namespace helical {

/// Checks of options as users give them. Throws Error(kInput) naming `key`, what is wrong, and the cure.
void requirePositive(double value, const char* key);  ///< and finite

}  // namespace helical
