#include "engine/config/transmitter_writer.h"

#include <charconv>
#include <sstream>

#include "engine/base/error.h"
#include "engine/config/rig_file.h"
#include "engine/config/rig_writer.h"
#include "engine/config/text_file.h"
#include "engine/transmitter/transmitter_options.h"

namespace helical {
namespace {

std::string trimmed(const std::string& line) {
  const std::size_t from = line.find_first_not_of(" \t\r"), to = line.find_last_not_of(" \t\r");
  return from == std::string::npos ? "" : line.substr(from, to - from + 1);
}

/// Of a table or an array of tables: `[name]`, `[[name]]`, with or without a comment behind it.
bool isHeader(const std::string& line, const std::string& name) {
  const std::string text = trimmed(line);
  return text.starts_with(name) && (text.size() == name.size() || trimmed(text.substr(name.size())).starts_with("#"));
}

/// The shortest that reads back as the same number.
std::string exact(double value) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, value).ptr;
  std::string number(text, end);
  if (number.find_first_of(".en") == std::string::npos) number += ".0";
  return number;
}

std::string channelText(const OutputChannel& channel) {
  std::string text = "\n[[transmitter.channel]]\nstick = \"" + std::string(toString(channel.axis)) + "\"\n";
  text += "output = " + std::to_string(channel.output) + "\n";
  text += "minimum = " + exact(channel.minimum) + "\nneutral = " + exact(channel.neutral) + "\nmaximum = " +
          exact(channel.maximum) + "\n";
  if (channel.trim != 0.0) text += "trim = " + exact(channel.trim) + "\n";
  if (channel.reverse) text += "reverse = true\n";
  if (channel.slew_per_s != 0.0) text += "slew_per_s = " + exact(channel.slew_per_s) + "\n";
  return text;
}

bool isKey(const std::string& line, const std::string& key) {
  const std::string text = trimmed(line);
  return text.starts_with(key) && trimmed(text.substr(key.size())).starts_with("=");
}

}  // namespace

std::string rigWithChannels(std::string_view toml, const std::string& name, const OutputChannels& channels,
                            const std::string& directions_checked) {
  std::istringstream lines{std::string(toml)};
  std::string text;
  bool in_channel = false, in_transmitter = false;
  for (std::string line; std::getline(lines, line);) {
    if (trimmed(line).starts_with("[")) {
      in_channel = isHeader(line, "[[transmitter.channel]]");
      in_transmitter = isHeader(line, "[transmitter]");
    }
    if (in_channel || (in_transmitter && isKey(line, "directions_checked"))) continue;
    text += line + "\n";
    if (in_transmitter && isHeader(line, "[transmitter]") && !directions_checked.empty())
      text += "directions_checked = \"" + directions_checked + "\"\n";
  }
  while (text.ends_with("\n\n")) text.pop_back();
  for (const OutputChannel& channel : channels.span()) text += channelText(channel);
  // What it says now is what was meant, or it is not written at all.
  const TransmitterOptions read = parseRig(text, name).transmitter;
  if (fingerprintOf(read.channels) != fingerprintOf(channels) || read.directions_checked != directions_checked)
    throw Error(ErrorKind::kInput,
                "the transmitter's table is written in a way that cannot be changed line by line", name,
                "write [transmitter] and [[transmitter.channel]] as tables of their own");
  return text;
}

void writeChannels(const std::filesystem::path& rig, const std::filesystem::path& out, const OutputChannels& channels,
                   bool checked) {
  writeTextFile(out, rigWithChannels(readTextFile(rig, "rig file"), rig.string(), channels,
                                     checked ? fingerprintText(channels) : std::string()));
}

}  // namespace helical
