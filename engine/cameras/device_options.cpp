#include "engine/cameras/device_options.h"

#include <sstream>

#include "engine/base/error.h"

namespace helical {
namespace {

void requireRange(double value, double low, double high, const char* key) {
  if (value >= low && value <= high) return;
  std::ostringstream what, cure;
  what << key << " is " << value;
  cure << "give " << low << " to " << high;
  throw Error(ErrorKind::kInput, what.str(), {}, cure.str());
}

}  // namespace

void validate(const DeviceOptions& o) {
  requireRange(o.offset_x, 0, 16384, "offset");
  requireRange(o.offset_y, 0, 16384, "offset");
  requireRange(o.rate_hz, 0.1, 1000.0, "rate_hz");
  if (o.exposure_us) requireRange(*o.exposure_us, 1.0, 1e6, "exposure_us");
  if (o.gain_db) requireRange(*o.gain_db, 0.0, 60.0, "gain_db");
  if (o.balance_red) requireRange(*o.balance_red, 0.01, 100.0, "balance_red");
  if (o.balance_blue) requireRange(*o.balance_blue, 0.01, 100.0, "balance_blue");
  requireRange(o.readout_ms, 0.0, 1000.0, "readout_ms");
  requireRange(o.packet_bytes, 576, 16'000, "packet_bytes");
  requireRange(o.packet_delay_us, 0.0, 1000.0, "packet_delay_us");
  requireRange(o.frame_retention_ms, 1.0, 1000.0, "frame_retention_ms");
  requireRange(o.silence_ms, 50.0, 60'000.0, "silence_ms");
}

}  // namespace helical
