#pragma once

#include <filesystem>

namespace helical::test {

/// Does with a file all that a user can: opens it both ways, reads every message, exports tables, plays and
/// seeks, looks at pictures, sums up, replays, mends a copy. Whatever the file holds, `Error` is the only thing
/// that may be thrown, and it is caught here. `scratch` is written to. Returns how many steps were refused.
int exerciseSession(const std::filesystem::path& file, const std::filesystem::path& scratch);

}  // namespace helical::test
