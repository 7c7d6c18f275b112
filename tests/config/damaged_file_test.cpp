// Whatever happens to a file, loading it gives a rig or plan, or an Error; nothing else, and no crash.

#include <gtest/gtest.h>

#include <string>

#include "engine/base/random.h"
#include "engine/config/plan_file.h"
#include "engine/config/resource_files.h"
#include "engine/config/rig_file.h"
#include "engine/config/text_file.h"
#include "tests/config/rig_text.h"

namespace helical {
namespace {

template <class Parse>
bool loadsOrExplains(const std::string& text, Parse parse) {
  try {
    parse(text, "damaged.toml");
    return true;
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kInput);
    EXPECT_TRUE(error.where().starts_with("damaged.toml:")) << error.what();
    EXPECT_FALSE(error.problem().empty());
    EXPECT_FALSE(error.cure().empty());
    return false;
  }
}

template <class Parse>
void damage(const std::string& good, Parse parse) {
  ASSERT_TRUE(loadsOrExplains(good, parse));
  for (std::size_t length = 0; length < good.size(); ++length) loadsOrExplains(good.substr(0, length), parse);
  Random random(5);
  const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random.bits() % n); };
  for (int i = 0; i < 4000; ++i) {
    std::string text = good;
    text[below(text.size())] = static_cast<char>(random.bits());
    loadsOrExplains(text, parse);
  }
  for (int i = 0; i < 1000; ++i) {
    std::string text = good;
    const std::size_t from = below(text.size()), to = below(text.size());
    text.insert(to, good.substr(from, below(40)));
    text.erase(below(text.size()), below(10));
    loadsOrExplains(text, parse);
  }
}

TEST(DamagedFile, OfARigLoadsOrExplainsItself) {
  damage(readTextFile(resourceFolder() / "rigs" / "paper.toml", "rig file"), parseRig);
  damage(goodRig(), parseRig);
}

TEST(DamagedFile, OfAPlanLoadsOrExplainsItself) {
  damage(readTextFile(resourceFolder() / "plans" / "waypoints.toml", "flight plan"), parsePlan);
}

TEST(DamagedFile, NestedWithoutEndIsRefused) {
  EXPECT_FALSE(loadsOrExplains("a = " + std::string(100'000, '['), parseRig));
  EXPECT_FALSE(loadsOrExplains(std::string(100'000, '['), parseRig));
  std::string braces = "a = ";
  for (int i = 0; i < 50'000; ++i) braces += "{a=";
  EXPECT_FALSE(loadsOrExplains(braces, parseRig));
}

}  // namespace
}  // namespace helical
