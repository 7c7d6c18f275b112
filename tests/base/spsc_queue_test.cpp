#include "engine/base/spsc_queue.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <thread>

namespace helical {
namespace {

TEST(SpscQueue, IsFirstInFirstOutAndRefusesWhenFull) {
  SpscQueue<int, 4> queue;
  int value = -1;
  EXPECT_FALSE(queue.pop(value));
  for (int round = 0; round < 10; ++round) {
    for (int i = 0; i < 4; ++i) EXPECT_TRUE(queue.push(10 * round + i));
    EXPECT_FALSE(queue.push(99));
    for (int i = 0; i < 4; ++i) {
      ASSERT_TRUE(queue.pop(value));
      EXPECT_EQ(value, 10 * round + i);
    }
    EXPECT_FALSE(queue.pop(value));
  }
}

TEST(SpscQueue, CarriesEveryValueBetweenThreadsInOrder) {
  constexpr std::uint64_t kValues = 200'000;
  using Wide = std::array<std::uint64_t, 8>;
  SpscQueue<Wide, 16> queue;
  std::jthread producer([&] {
    Wide value{};
    for (std::uint64_t i = 1; i <= kValues; ++i) {
      value.fill(i);
      while (!queue.push(value)) std::this_thread::yield();
    }
  });
  Wide value{};
  for (std::uint64_t i = 1; i <= kValues; ++i) {
    while (!queue.pop(value)) std::this_thread::yield();
    for (const std::uint64_t word : value) ASSERT_EQ(word, i);
  }
  EXPECT_FALSE(queue.pop(value));
}

}  // namespace
}  // namespace helical
