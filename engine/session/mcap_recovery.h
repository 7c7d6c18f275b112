#pragma once

#include <cstdint>
#include <filesystem>

namespace helical {

/// What became of a cut-off or damaged file.
struct Recovery {
  bool was_complete = false;         ///< nothing to mend: the file was left alone
  std::uint64_t messages = 0;        ///< in it now
  std::uint64_t damaged_chunks = 0;  ///< left out
  std::filesystem::path original;    ///< where the damaged file was kept; empty when nothing was left out
};

/// Mends an MCAP file in place: every sound chunk, a new index, a new summary. The mended file takes the
/// place of the old one in one step, when it is whole on the disk; an old one that held more than could be
/// read is kept beside it as FILE.damaged, for better tools than ours. Throws Error(kInput) for a file that
/// nothing can be saved of, Error(kSystem) when the disk refuses; the old file is then as it was.
Recovery recoverMcap(const std::filesystem::path& file);

}  // namespace helical
