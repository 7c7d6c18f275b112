#include "engine/config/device_table.h"

#include <cmath>
#include <string>

namespace helical {
namespace {

void readTrigger(TomlTable& table, DeviceOptions& options) {
  const std::string trigger = table.text("trigger").value_or("free");
  if (trigger == "free")
    options.trigger = TriggerMode::kFree;
  else if (trigger == "software")
    options.trigger = TriggerMode::kSoftware;
  else if (trigger == "action")
    options.trigger = TriggerMode::kAction;
  else if (trigger == "line")
    options.trigger = TriggerMode::kLine;
  else
    table.fail("trigger", "unknown trigger '" + trigger + "'", "use \"free\", \"software\", \"line\" or \"action\"");
  options.trigger_line = table.text("trigger_line").value_or(options.trigger_line);
}

void readStamp(TomlTable& table, DeviceOptions& options) {
  const std::string stamped_at = table.text("stamped_at").value_or("start");
  if (stamped_at == "start")
    options.stamped_at = StampedAt::kStart;
  else if (stamped_at == "middle")
    options.stamped_at = StampedAt::kMiddle;
  else if (stamped_at == "end")
    options.stamped_at = StampedAt::kEnd;
  else
    table.fail("stamped_at", "unknown instant '" + stamped_at + "'", "use \"start\", \"middle\" or \"end\"");
}

void readOffset(TomlTable& table, DeviceOptions& options) {
  const auto offset = table.numbers("offset", 2);
  if (!offset) return;
  for (const double side : *offset)
    if (side < 0.0 || side > 16384.0 || side != std::floor(side))
      table.fail("offset", "'offset' is no place in an image", "give x and y in whole pixels, 0 and more");
  options.offset_x = static_cast<int>((*offset)[0]);
  options.offset_y = static_cast<int>((*offset)[1]);
}

}  // namespace

void readDeviceOptions(TomlTable table, DeviceOptions& options) {
  options.format = table.text("format").value_or("");
  readOffset(table, options);
  options.exposure_us = table.number("exposure_us");
  options.gain_db = table.number("gain_db");
  options.balance_red = table.number("balance_red");
  options.balance_blue = table.number("balance_blue");
  readTrigger(table, options);
  readStamp(table, options);
  options.ptp = table.boolean("ptp").value_or(false);
  options.packet_resend = table.boolean("packet_resend").value_or(true);
  options.packet_socket = table.boolean("packet_socket").value_or(false);
  options.packet_bytes = table.integer("packet_bytes").value_or(options.packet_bytes);
  for (const auto& [key, member] : {std::pair("rate_hz", &DeviceOptions::rate_hz),
                                    std::pair("readout_ms", &DeviceOptions::readout_ms),
                                    std::pair("packet_delay_us", &DeviceOptions::packet_delay_us),
                                    std::pair("frame_retention_ms", &DeviceOptions::frame_retention_ms),
                                    std::pair("silence_ms", &DeviceOptions::silence_ms)})
    options.*member = table.number(key).value_or(options.*member);
  table.finish();
  table.locate([&] { validate(options); });
}

}  // namespace helical
