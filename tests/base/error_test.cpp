#include "engine/base/error.h"

#include <gtest/gtest.h>

#include <string>

namespace helical {
namespace {

TEST(Error, SaysWhereWhatAndCure) {
  const Error error(ErrorKind::kInput, "'fx' is not positive", "rig.toml:12", "give it in pixels");
  EXPECT_STREQ(error.what(), "rig.toml:12: 'fx' is not positive\n  cure: give it in pixels");
  EXPECT_EQ(error.kind(), ErrorKind::kInput);
  EXPECT_EQ(error.problem(), "'fx' is not positive");
  EXPECT_EQ(error.where(), "rig.toml:12");
  EXPECT_EQ(error.cure(), "give it in pixels");
}

TEST(Error, LeavesOutWhatIsNotKnown) {
  EXPECT_STREQ(Error(ErrorKind::kDevice, "camera lost").what(), "camera lost");
  EXPECT_STREQ(Error(ErrorKind::kSystem, "disk full", "/data").what(), "/data: disk full");
}

}  // namespace
}  // namespace helical
