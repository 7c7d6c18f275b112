// The README beside the files explains every key that the readers know: the readers themselves list them, as
// the cure of an unknown key.

#include <gtest/gtest.h>

#include <sstream>

#include "engine/config/plan_file.h"
#include "engine/config/resource_files.h"
#include "engine/config/rig_file.h"
#include "engine/config/text_file.h"
#include "tests/config/rig_text.h"

namespace helical {
namespace {

const std::string kUnknown = "qqqqqqqqqqqqqqqq = 1\n";

std::vector<std::string> keysKnown(const Error& error) {
  const std::string start = "known here: ";
  const std::size_t at = error.cure().find(start);
  EXPECT_NE(at, std::string::npos) << error.what();
  std::istringstream list(at == std::string::npos ? "" : error.cure().substr(at + start.size()));
  std::vector<std::string> keys;
  for (std::string key; std::getline(list >> std::ws, key, ',');) keys.push_back(key);
  return keys;
}

/// The part of a README under the heading "## `title`".
std::string section(const std::string& readme, const std::string& title) {
  const std::size_t at = readme.find("\n## " + title + "\n");
  EXPECT_NE(at, std::string::npos) << title;
  if (at == std::string::npos) return "";
  return readme.substr(at, readme.find("\n## ", at + 1) - at);
}

void expectExplained(const std::string& section, const Error& error) {
  const auto keys = keysKnown(error);
  EXPECT_FALSE(keys.empty());
  for (const auto& key : keys) EXPECT_NE(section.find("`" + key + "`"), std::string::npos) << key;
}

TEST(Documentation, ExplainsEveryKeyOfARig) {
  const std::string readme = readTextFile(resourceFolder() / "rigs" / "README.md", "text");
  const auto check = [&](const std::string& title, const std::string& text) {
    expectExplained(section(readme, title), errorOf([&] { parseRig(text, "r"); }));
  };
  check("Top level", kUnknown + goodRig());
  check("`[[camera]]`", replaced(goodRig(), "size =", kUnknown + "size ="));
  check("`[camera.intrinsics]`", replaced(goodRig(), "fx =", kUnknown + "fx ="));
  check("`[camera.pose]`", replaced(goodRig(), "[camera.pose]", "[camera.pose]\n" + kUnknown));
  check("`[markers]`", replaced(goodRig(), "[markers]", "[markers]\n" + kUnknown));
  check("`[simulation]`", replaced(goodRig(), "[simulation]", "[simulation]\n" + kUnknown));
  check("`[camera.device]`", replaced(goodRig(), "[camera.pose]", "[camera.device]\n" + kUnknown + "[camera.pose]"));
  for (const std::string table : {"[helicopter]", "[helicopter.parameters]", "[helicopter.parameters.upper]",
                                  "[tracking]", "[calibration]", "[flight]", "[safety]", "[transmitter]",
                                  "[simulation.noise]", "[[simulation.camera]]"})
    check("`" + table + "`", goodRig() + table + "\n" + kUnknown);
}

TEST(Documentation, ExplainsEveryKeyOfAPlan) {
  const std::string readme = readTextFile(resourceFolder() / "plans" / "README.md", "text");
  const std::string plan = "format_version = 1\n[[waypoint]]\nposition_above_pad_m = [0, 0, 1]\n";
  expectExplained(readme.substr(0, readme.find("\n## ")), errorOf([&] { parsePlan(kUnknown + plan, "p"); }));
  expectExplained(section(readme, "`[[waypoint]]`"), errorOf([&] { parsePlan(plan + kUnknown, "p"); }));
}

}  // namespace
}  // namespace helical
