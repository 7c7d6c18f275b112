#pragma once

#include <filesystem>
#include <string>

#include "engine/base/random.h"

namespace helical::test {

/// A file's bytes with damage of one kind or several: flipped bits, cut off, blocks set to zero, filled at
/// random, exchanged or doubled, records doubled, left out, or with lengths and sizes beyond all reason.
std::string mutateBytes(const std::string& bytes, Random& random);

/// A sound MCAP file that says other things than `from`: its messages, definitions and attachments are
/// damaged, and all check sums are right.
void mutateContent(const std::filesystem::path& from, const std::filesystem::path& to, Random& random);

}  // namespace helical::test
