#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "engine/session/export_selection.h"
#include "engine/session/mcap_reader.h"

namespace helical {

struct CsvExport {
  std::vector<std::filesystem::path> files;  ///< tables, README and the session's own files
  McapReader::Reading reading;
};

/// Which streams become tables, and what of them.
struct CsvSelection {
  std::set<std::string> topics;  ///< all but images when empty
  ExportSpan span;
};

/// Streams of a session that can become tables, in the order of their names.
std::vector<std::string> tableTopics(const McapReader& session);

/// Writes one CSV table for every chosen stream of a session that has messages: `time_s` and a column for each
/// field, with its unit in the header; beside them README.md, which explains the columns, and the files that
/// the session holds. Makes the folder. Throws Error(kInput) for a folder that cannot be written to or
/// messages that cannot be read or a
/// stream that the session does not have.
CsvExport exportCsv(McapReader& session, const std::filesystem::path& folder, const CsvSelection& selection = {},
                    const ExportProgress& progress = {});

}  // namespace helical
