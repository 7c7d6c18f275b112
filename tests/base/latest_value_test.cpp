#include "engine/base/latest_value.h"

#include <gtest/gtest.h>

#include <array>
#include <thread>

namespace helical {
namespace {

TEST(LatestValue, HasNothingUntilSomethingIsPublished) {
  LatestValue<int> value;
  EXPECT_FALSE(value.take());
  EXPECT_EQ(value.front(), 0);
}

TEST(LatestValue, GivesTheNewestOnceAndSkipsTheRest) {
  LatestValue<int> value;
  for (int i = 1; i <= 5; ++i) {
    value.back() = i;
    value.publish();
  }
  EXPECT_TRUE(value.take());
  EXPECT_EQ(value.front(), 5);
  EXPECT_FALSE(value.take());
  EXPECT_EQ(value.front(), 5);
}

TEST(LatestValue, IsNeverTornNorOlderThanBefore) {
  constexpr int kValues = 200'000;
  using Wide = std::array<int, 64>;
  LatestValue<Wide> value;
  std::jthread writer([&] {
    for (int i = 1; i <= kValues; ++i) {
      value.back().fill(i);
      value.publish();
    }
  });
  int newest = 0;
  while (newest < kValues) {
    if (!value.take()) {
      std::this_thread::yield();
      continue;
    }
    const Wide& seen = value.front();
    ASSERT_GT(seen.front(), newest);
    newest = seen.front();
    for (const int word : seen) ASSERT_EQ(word, newest);
  }
  EXPECT_FALSE(value.take());
}

}  // namespace
}  // namespace helical
