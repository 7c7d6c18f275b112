#include "engine/config/transmitter_table.h"

#include <algorithm>
#include <string>

#include "engine/config/option_fields.h"
#include "engine/transmitter/shared_output.h"

namespace helical {
namespace {

constexpr OptionField<TransmitterOptions> kTransmitterFields[] = {
    {"rate_hz", &TransmitterOptions::rate_hz},
    {"trainer_input", &TransmitterOptions::trainer_input, 1.0, 1, 7},
};

constexpr OptionField<OutputGuardOptions> kGuardFields[] = {
    {"silent_s", &OutputGuardOptions::silent_s, 1.0, 0.02, 0.14},
    {"hold_s", &OutputGuardOptions::hold_s, 1.0, 0.01, 10.0},
    {"ramp_per_s", &OutputGuardOptions::ramp_per_s, 1.0, 0.05, 100.0},
};

constexpr OptionField<OutputChannel> kChannelFields[] = {
    {"output", &OutputChannel::output, 1.0, 0, 15},   {"minimum", &OutputChannel::minimum},
    {"neutral", &OutputChannel::neutral},             {"maximum", &OutputChannel::maximum},
    {"trim", &OutputChannel::trim},                   {"slew_per_s", &OutputChannel::slew_per_s},
};

constexpr OptionField<RadioOptions> kRadioFields[] = {
    {"channel", &RadioOptions::channel},
    {"rate_kbps", &RadioOptions::rate_kbps},
    {"power", &RadioOptions::power},
};

StickAxis readAxis(TomlTable& table) {
  const std::string name = table.required("stick", table.text("stick"), std::string("roll"), "stick = \"roll\"");
  for (const StickAxis axis : kAllAxes)
    if (name == toString(axis)) return axis;
  table.fail("stick", "unknown stick '" + name + "'",
             "use \"upper_rotor\", \"lower_rotor\", \"throttle\", \"yaw\", \"roll\" or \"pitch\"");
}

void readChannel(TomlTable& table, OutputChannels& channels) {
  if (channels.count == static_cast<int>(channels.all.size()))
    table.fail("stick", "more channels than there are sticks", "give each stick one [[transmitter.channel]]");
  OutputChannel& channel = channels.all[static_cast<std::size_t>(channels.count)];
  channel.axis = readAxis(table);
  channel.output = channels.count;
  ++channels.count;
  const auto required = [&](const char* key) {
    table.required(key, table.number(key), 0.0, std::string(key) + ", in the device's unit");
  };
  for (const char* key : {"minimum", "neutral", "maximum"}) required(key);
  readOptions(table, kChannelFields, channel);
  channel.reverse = table.boolean("reverse").value_or(false);
  table.finish();
}

void readAddress(TomlTable& table, RadioOptions& radio) {
  const auto text = table.text("address");
  if (!text) return;
  const bool digits = text->size() == 2 * radio.address.size() &&
                      text->find_first_not_of("0123456789abcdefABCDEF") == std::string::npos;
  if (!digits)
    table.fail("address", "'address' is no radio address", "give ten hexadecimal digits, such as \"E7E7E7E7E7\"");
  for (std::size_t i = 0; i < radio.address.size(); ++i)
    radio.address[i] = static_cast<std::uint8_t>(std::stoi(text->substr(2 * i, 2), nullptr, 16));
}

void readRadio(TomlTable table, RadioOptions& radio) {
  readOptions(table, kRadioFields, radio);
  readAddress(table, radio);
  table.finish();
  table.locate([&] { validate(radio); });
}

}  // namespace

void readTransmitterOptions(TomlTable table, TransmitterOptions& options) {
  options.kind = table.text("kind").value_or(options.kind);
  const auto kinds = transmitterKinds();
  if (std::find(kinds.begin(), kinds.end(), options.kind) == kinds.end()) {
    std::string known;
    for (const auto kind : kinds) known += (known.empty() ? "\"" : ", \"") + std::string(kind) + "\"";
    table.fail("kind", "the transmitter '" + options.kind + "' is not built yet", "use one of " + known);
  }
  options.device = table.text("device").value_or(options.device);
  options.address = table.text("address").value_or(options.address);
  options.bench = table.boolean("bench").value_or(options.bench);
  options.directions_checked = table.text("directions_checked").value_or(options.directions_checked);
  readRadio(table.table("radio"), options.radio);
  for (TomlTable& channel : table.tables("channel")) readChannel(channel, options.channels);
  readOptions(table, kGuardFields, options.guard);
  readOptions(table, kTransmitterFields, options);
  table.finish();
  table.locate([&] {
    validate(options);
    outputSettings(options);
  });
}

}  // namespace helical
