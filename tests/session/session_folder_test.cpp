#include "engine/session/session_folder.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <ctime>

#include "engine/session/mcap_recovery.h"
#include "engine/session/mcap_writer.h"
#include "tests/session/session_fixture.h"

namespace helical {
namespace {

using test::TemporaryFolder;

TEST(SessionFolder, IsInTheUsersDataFolder) {
  const TemporaryFolder folder;
  ASSERT_EQ(::setenv("XDG_DATA_HOME", (folder / "data").c_str(), 1), 0);
  EXPECT_EQ(sessionFolder(), folder / "data/helical/sessions");
  ASSERT_EQ(::setenv("XDG_DATA_HOME", "relative", 1), 0);
  ASSERT_EQ(::setenv("HOME", "/home/somebody", 1), 0);
  EXPECT_EQ(sessionFolder(), "/home/somebody/.local/share/helical/sessions");
}

TEST(SessionFolder, NamesFilesByTimeAndRigAndNeverTwice) {
  const TemporaryFolder folder;
  const auto moment = std::chrono::system_clock::from_time_t(1795811729);
  const auto first = newSessionFile(folder / "new/sessions", "/rigs/my rig.toml", moment);
  EXPECT_EQ(first, folder / "new/sessions/2026-11-27T20-35-29_my rig.mcap");
  test::writeBytes(first, "");
  EXPECT_EQ(newSessionFile(folder / "new/sessions", "/rigs/my rig.toml", moment).filename(),
            "2026-11-27T20-35-29_my rig_2.mcap");
}

TEST(SessionFolder, KnowsWhatWasCutOffFromWhatIsBeingWritten) {
  const TemporaryFolder folder;
  McapWriter(folder / "whole.mcap", "library").close();
  {
    McapWriter cut(folder / "cut.mcap", "library");
    cut.addChannel(cut.addSchema("pkg/msg/Name", "ros2msg", "float64 x\n"), "/topic", "cdr");
  }
  test::writeBytes(folder / "notes.txt", "something else, long enough to be cut off");
  McapWriter live(folder / "live.mcap", "library");
  const std::filesystem::path place = (folder / "x").parent_path();
  EXPECT_EQ(cutOffSessions(place), std::vector{folder / "cut.mcap"});
  recoverMcap(folder / "cut.mcap");
  EXPECT_TRUE(cutOffSessions(place).empty());
  EXPECT_TRUE(cutOffSessions("/no/such/folder").empty());
}

}  // namespace
}  // namespace helical
