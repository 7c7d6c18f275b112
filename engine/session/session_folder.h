#pragma once

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

namespace helical {

/// Where flights are recorded when nobody names a file: `helical/sessions` in the user's data folder, which
/// is $XDG_DATA_HOME or ~/.local/share.
std::filesystem::path sessionFolder();

/// A file in `folder` that does not exist yet, named by the time (UTC) and the rig:
/// "2026-11-27T20-35-29_paper.mcap". Makes the folder; throws Error(kSystem) when it cannot be made.
std::filesystem::path newSessionFile(const std::filesystem::path& folder, const std::string& rig_file,
                                     std::chrono::system_clock::time_point begin);

/// Sessions in `folder` that were cut off, the newest first: those that somebody records just now are none.
/// Empty for a folder that cannot be read.
std::vector<std::filesystem::path> cutOffSessions(const std::filesystem::path& folder);

}  // namespace helical
