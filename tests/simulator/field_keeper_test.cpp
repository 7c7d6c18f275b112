#include "engine/simulator/field_keeper.h"

#include <gtest/gtest.h>

#include <array>
#include <optional>
#include <span>

namespace helical {
namespace {

constexpr int kBackgroundFrames = 8;
constexpr int kFramesNeeded = kBackgroundFrames + 30;

/// Two cameras of 60 Hz, looked at every 10 ms.
class Field : public ::testing::Test {
 protected:
  bool pass(int milliseconds) {
    bool in = false;
    for (const int end = ms_ + milliseconds; ms_ < end; ms_ += 10) {
      for (auto& camera : cameras_) camera.frames += camera.streaming && ms_ % 50 < 30;
      in = keeper_.helicopterIn(ms_ * kNanosecondsPerMillisecond, on_, cameras_);
    }
    return in;
  }
  void switchOn() { on_ = ms_ * kNanosecondsPerMillisecond; }
  void switchOff() { on_.reset(); }
  void look(std::size_t camera, bool streaming = true) { cameras_[camera].streaming = streaming; }

 private:
  FieldKeeper keeper_{2, kBackgroundFrames};
  std::array<FieldKeeper::Camera, 2> cameras_;
  std::optional<TimeNs> on_;
  int ms_ = 0;
};

TEST_F(Field, IsEmptyWhileNobodyLooks) {
  EXPECT_FALSE(pass(60'000));
  look(0);
  EXPECT_FALSE(pass(9'000)) << "whoever only looks on may take a background first";
  EXPECT_TRUE(pass(2'000));
  look(0, false);
  EXPECT_FALSE(pass(10)) << "the next client needs the empty field from its first frame on";
}

TEST_F(Field, IsEmptyUntilTheLastCameraHasSeenItSo) {
  switchOn();
  EXPECT_FALSE(pass(1'000));
  look(0);
  EXPECT_FALSE(pass(1'000));
  look(1);
  EXPECT_FALSE(pass(1'400)) << "the second one began later";
  EXPECT_TRUE(pass(200));
}

TEST(FieldOfASlowCamera, IsEmptyUntilItHasShownEnough) {
  FieldKeeper keeper(1, kBackgroundFrames);
  FieldKeeper::Camera slow{true, 0};
  const TimeNs on = 0;
  const auto in = [&](int second) {
    return keeper.helicopterIn(second * kNanosecondsPerSecond, on, std::span(&slow, 1));
  };
  EXPECT_FALSE(in(0));
  slow.frames = kFramesNeeded - 1;
  EXPECT_FALSE(in(30));
  slow.frames = kFramesNeeded;
  EXPECT_TRUE(in(31));
}

TEST_F(Field, KeepsTheHelicopterWhileCamerasComeAndGo) {
  switchOn();
  look(0);
  look(1);
  EXPECT_TRUE(pass(2'000));
  look(1, false);
  EXPECT_TRUE(pass(3'000));
  look(1);
  EXPECT_TRUE(pass(10)) << "a cable that was out for a while is no new client";
  switchOff();
  EXPECT_TRUE(pass(20'000)) << "it stays where it landed, to be looked at";
  switchOn();
  EXPECT_FALSE(pass(10)) << "a new flight needs a new background";
}

TEST_F(Field, WithATransmitterButNoCamerasGetsAHelicopterAllTheSame) {
  switchOn();
  EXPECT_FALSE(pass(9'000));
  EXPECT_TRUE(pass(2'000));
}

}  // namespace
}  // namespace helical
