#include "engine/transmitter/radio_options.h"

#include <string>

#include "engine/base/error.h"

namespace helical {

void validate(const RadioOptions& o) {
  if (o.channel < 0 || o.channel > 125)
    throw Error(ErrorKind::kInput, "channel is " + std::to_string(o.channel), {}, "give 0 to 125");
  if (o.rate_kbps != 250 && o.rate_kbps != 1000 && o.rate_kbps != 2000)
    throw Error(ErrorKind::kInput, "rate_kbps is " + std::to_string(o.rate_kbps), {}, "give 250, 1000 or 2000");
  if (o.power < 0 || o.power > 3)
    throw Error(ErrorKind::kInput, "power is " + std::to_string(o.power), {}, "give 0 to 3");
}

}  // namespace helical
