#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "engine/transmitter/output_channel.h"

namespace helical {

/// A rig file's text with these channels in place of those it has, all other lines as they are;
/// `directions_checked` as its key has it, empty for none. Throws Error(kInput) when the text is no rig with
/// a table [transmitter], or is written in a way that cannot be changed line by line.
std::string rigWithChannels(std::string_view toml, const std::string& name, const OutputChannels& channels,
                            const std::string& directions_checked);

/// The file `rig` with these channels, as `out`, which may be the same; `checked`: somebody has seen which
/// way the sticks go. Throws Error(kInput) as rigWithChannels, Error(kSystem) when it cannot be written.
void writeChannels(const std::filesystem::path& rig, const std::filesystem::path& out, const OutputChannels& channels,
                   bool checked);

}  // namespace helical
