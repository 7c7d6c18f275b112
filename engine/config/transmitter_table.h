#pragma once

#include "engine/config/toml_table.h"
#include "engine/transmitter/transmitter_options.h"

namespace helical {

/// The table [transmitter] with [[transmitter.channel]] and [transmitter.radio]. Throws as TomlTable, for unknown keys and
/// for what validate() refuses.
void readTransmitterOptions(TomlTable table, TransmitterOptions& options);

}  // namespace helical
