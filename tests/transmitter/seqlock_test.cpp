#include "engine/transmitter/seqlock.h"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>

namespace helical {
namespace {

struct Several {
  std::uint64_t a = 0, b = 0, c = 0;
  std::uint32_t d = 0;
};

TEST(Seqlock, HasNothingBeforeTheFirstValue) {
  Seqlock<Several> lock;
  Several value;
  EXPECT_FALSE(lock.read(value));
  lock.write({1, 2, 3, 4});
  ASSERT_TRUE(lock.read(value));
  EXPECT_EQ(value.c, 3u);
  EXPECT_EQ(value.d, 4u);
}

TEST(Seqlock, ReadersSeeWholeValuesInTheirOrder) {
  Seqlock<Several> lock;
  std::atomic<bool> done{false};
  std::thread writer([&] {
    for (std::uint32_t i = 1; i <= 200'000; ++i) lock.write({i, 2 * i, 3 * i, i});
    done = true;
  });
  std::uint64_t last = 0;
  int whole = 0;
  for (bool last_round = false; !last_round;) {
    last_round = done;
    Several value;
    if (!lock.read(value)) continue;
    ++whole;
    EXPECT_EQ(value.b, 2 * static_cast<std::uint32_t>(value.a));
    EXPECT_EQ(value.c, 3 * static_cast<std::uint32_t>(value.a));
    EXPECT_EQ(value.d, value.a);
    EXPECT_GE(value.a, last);
    last = value.a;
  }
  writer.join();
  EXPECT_GT(whole, 0);
  EXPECT_EQ(last, 200'000u);
}

}  // namespace
}  // namespace helical
