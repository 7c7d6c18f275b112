#include "engine/base/require.h"

#include <cmath>
#include <string>

#include "engine/base/error.h"

namespace helical {

void requirePositive(double value, const char* key) {
  if (!(value > 0.0 && std::isfinite(value)))
    throw Error(ErrorKind::kInput, std::string(key) + " is " + std::to_string(value), {},
                "give a number above 0");
}

}  // namespace helical
