#pragma once

#include <filesystem>
#include <vector>

#include "engine/session/mcap_reader.h"

namespace helical {

struct CsvExport {
  std::vector<std::filesystem::path> files;  ///< tables, README and the session's own files
  McapReader::Reading reading;
};

/// Writes one CSV table for every stream of a session that has messages: `time_s` and a column for each
/// field, with its unit in the header; beside them README.md, which explains the columns, and the files that
/// the session holds. Makes the folder. Throws Error(kInput) for a folder that cannot be written to or
/// messages that cannot be read.
CsvExport exportCsv(McapReader& session, const std::filesystem::path& folder);

}  // namespace helical
