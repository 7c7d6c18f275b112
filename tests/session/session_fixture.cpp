#include "tests/session/session_fixture.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <sstream>

#include "engine/config/plan_file.h"
#include "engine/config/resource_files.h"
#include "engine/config/rig_file.h"
#include "engine/config/text_file.h"

namespace helical::test {

TemporaryFolder::TemporaryFolder() {
  std::string name = (std::filesystem::temp_directory_path() / "helical-session-XXXXXX").string();
  path_ = ::mkdtemp(name.data());
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

std::string bytesOf(const std::filesystem::path& file) {
  std::ostringstream bytes;
  bytes << std::ifstream(file, std::ios::binary).rdbuf();
  return bytes.str();
}

void writeBytes(const std::filesystem::path& file, const std::string& bytes) {
  std::ofstream(file, std::ios::binary) << bytes;
}

std::vector<std::string> messagesOf(McapReader& reader) {
  std::vector<std::string> messages;
  reader.read([&](const McapMessage& message) {
    messages.push_back(reader.channels().at(message.channel).topic + "@" + std::to_string(message.log_time) +
                       ":" + std::string(message.payload));
  });
  return messages;
}

std::vector<std::string> messagesOf(const std::filesystem::path& file) {
  McapReader reader(file);
  return messagesOf(reader);
}

SessionSettings hoverSettings(std::uint64_t seed) {
  const std::filesystem::path rig = resourceFolder() / "rigs" / "paper.toml";
  SessionSettings settings;
  settings.rig_text = readTextFile(rig, "rig file");
  settings.plan_text = readTextFile(planPath("hover"), "flight plan");
  settings.rig = loadRig(rig);
  settings.rig.simulation.seed = seed;
  settings.rig.simulation.images = false;
  settings.plan = loadPlan(planPath("hover"));
  return settings;
}

}  // namespace helical::test
