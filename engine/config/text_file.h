#pragma once

#include <filesystem>
#include <string>

namespace helical {

/// The whole of a small text file. Throws Error(kInput) saying what is wrong with it when it is missing, a
/// folder, unreadable or larger than any file of ours.
std::string readTextFile(const std::filesystem::path& file, const std::string& what_it_is);

}  // namespace helical
