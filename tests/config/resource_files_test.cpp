#include "engine/config/resource_files.h"

#include <gtest/gtest.h>

#include <cstdlib>

#include "tests/config/rig_text.h"

namespace helical {
namespace {

class ResourceFiles : public testing::Test {
 protected:
  void TearDown() override { unsetenv("HELICAL_RESOURCES"); }
};

TEST_F(ResourceFiles, AreThoseOfTheSourceTreeUntilInstalled) {
  unsetenv("HELICAL_RESOURCES");
  EXPECT_EQ(resourceFolder(), std::filesystem::path(HELICAL_SOURCE_DIR) / "resources");
}

TEST_F(ResourceFiles, AreWhereTheEnvironmentSays) {
  setenv("HELICAL_RESOURCES", HELICAL_SOURCE_DIR "/tests", 1);
  EXPECT_EQ(resourceFolder(), std::filesystem::path(HELICAL_SOURCE_DIR) / "tests");
  setenv("HELICAL_RESOURCES", "/no/such/folder", 1);
  const Error error = errorOf([] { resourceFolder(); });
  EXPECT_EQ(error.kind(), ErrorKind::kSystem);
  EXPECT_FALSE(error.cure().empty());
}

TEST_F(ResourceFiles, PlansGoByNameOrByPath) {
  EXPECT_EQ(planPath("hover"), resourceFolder() / "plans" / "hover.toml");
  EXPECT_EQ(planPath("./hover"), "./hover");
  EXPECT_EQ(planPath("mine.toml"), "mine.toml");
  const Error error = errorOf([] { planPath("loop"); });
  EXPECT_EQ(error.kind(), ErrorKind::kInput);
  EXPECT_NE(error.cure().find("hover, waypoints"), std::string::npos) << error.cure();
}

}  // namespace
}  // namespace helical
