#include "engine/pipeline/hand_over.h"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>

namespace helical {
namespace {

/// Counts how many of them live, and on which thread they die.
struct Counted {
  explicit Counted(int number) : value(number) { ++alive; }
  ~Counted() {
    --alive;
    if (std::this_thread::get_id() != giver) died_elsewhere = true;
  }
  int value;
  static inline std::atomic<int> alive{0};
  static inline std::atomic<bool> died_elsewhere{false};
  static inline std::thread::id giver;
};

TEST(HandOver, TheNewestOfferArrivesAndNothingIsLost) {
  Counted::giver = std::this_thread::get_id();
  {
    HandOver<Counted> hand_over;
    EXPECT_EQ(hand_over.take(), nullptr);
    hand_over.offer(std::make_unique<Counted>(1));
    hand_over.offer(std::make_unique<Counted>(2));
    std::unique_ptr<Counted> taken = hand_over.take();
    ASSERT_NE(taken, nullptr);
    EXPECT_EQ(taken->value, 2);
    hand_over.giveBack(std::move(taken));
    hand_over.offer(std::make_unique<Counted>(3));
  }
  EXPECT_EQ(Counted::alive, 0);
}

TEST(HandOver, NothingNewIsTakenUntilTheOldOneIsCollected) {
  Counted::giver = std::this_thread::get_id();
  HandOver<Counted> hand_over;
  hand_over.offer(std::make_unique<Counted>(1));
  hand_over.giveBack(hand_over.take());
  hand_over.offer(std::make_unique<Counted>(2));  // collects as well
  EXPECT_NE(hand_over.take(), nullptr);
}

TEST(HandOver, TheReceiverNeverFrees) {
  Counted::giver = std::this_thread::get_id();
  Counted::died_elsewhere = false;
  HandOver<Counted> hand_over;
  std::atomic<int> newest{0};
  {
    std::jthread receiver([&](const std::stop_token& stop) {
      while (!stop.stop_requested()) {
        auto taken = hand_over.take();
        if (!taken) continue;
        EXPECT_GT(taken->value, newest);
        newest = taken->value;
        hand_over.giveBack(std::move(taken));
      }
    });
    for (int i = 1; i <= 20'000; ++i) hand_over.offer(std::make_unique<Counted>(i));
    while (newest < 20'000) hand_over.collect();
  }
  EXPECT_FALSE(Counted::died_elsewhere);
}

}  // namespace
}  // namespace helical
