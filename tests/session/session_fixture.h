#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "engine/session/mcap_reader.h"
#include "engine/session/session_settings.h"

namespace helical::test {

/// A folder of its own for one test, gone at its end.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

 private:
  std::filesystem::path path_;
};

std::string bytesOf(const std::filesystem::path& file);
void writeBytes(const std::filesystem::path& file, const std::string& bytes);

/// Every message as "topic@time:payload".
std::vector<std::string> messagesOf(McapReader& reader);
std::vector<std::string> messagesOf(const std::filesystem::path& file);

/// The paper's rig and the hover plan, image-free.
SessionSettings hoverSettings(std::uint64_t seed);

}  // namespace helical::test
