#include "engine/pipeline/output_loop.h"

#include <gtest/gtest.h>

namespace helical {
namespace {

class RecordingTransmitter final : public Transmitter {
 public:
  void send(const StickDemand& demand, TimeNs) override { last = demand; }
  StickDemand last;
};

constexpr StickDemand kFlying{0.5, 0.52, 0.1, -0.2};
constexpr TimeNs kMs = kNanosecondsPerMillisecond;

TEST(OutputLoop, SendsTheNewestDemand) {
  RecordingTransmitter transmitter;
  OutputLoop output(transmitter);
  output.submit({0.1, 0.1, 0, 0}, 0);
  output.submit(kFlying, 1 * kMs);
  output.step(2 * kMs);
  EXPECT_EQ(transmitter.last, kFlying);
}

TEST(OutputLoop, GoesNeutralWhenTheFlightThreadIsSilent) {
  RecordingTransmitter transmitter;
  OutputLoop output(transmitter);
  output.submit(kFlying, 0);
  output.step(100 * kMs);
  EXPECT_EQ(transmitter.last, kFlying);
  output.step(105 * kMs);
  EXPECT_EQ(transmitter.last.roll, 0.0);
  EXPECT_EQ(transmitter.last.pitch, 0.0);
  EXPECT_EQ(transmitter.last.upper_rotor, kFlying.upper_rotor);
}

TEST(OutputLoop, TakesUpAgainAfterAShortSilence) {
  RecordingTransmitter transmitter;
  OutputLoop output(transmitter);
  output.submit(kFlying, 0);
  output.step(300 * kMs);
  output.submit(kFlying, 301 * kMs);
  output.step(302 * kMs);
  EXPECT_EQ(transmitter.last, kFlying);
}

TEST(OutputLoop, RampsToZeroAndNeverStartsTheRotorsAgain) {
  RecordingTransmitter transmitter;
  OutputLoop output(transmitter);
  output.submit(kFlying, 0);
  double last = 1.0;
  for (TimeNs now = 0; now < 4000 * kMs; now += 5 * kMs) {
    output.step(now);
    EXPECT_LE(transmitter.last.upper_rotor, last);
    last = transmitter.last.upper_rotor;
  }
  EXPECT_EQ(transmitter.last, StickDemand{});
  output.submit(kFlying, 4000 * kMs);
  output.step(4001 * kMs);
  EXPECT_EQ(transmitter.last, StickDemand{});
}

TEST(OutputLoop, KillWinsOverEveryDemand) {
  RecordingTransmitter transmitter;
  OutputLoop output(transmitter);
  output.submit(kFlying, 0);
  output.kill();
  for (TimeNs now = 0; now < 50 * kMs; now += 5 * kMs) {
    output.submit(kFlying, now);
    output.step(now);
    EXPECT_EQ(transmitter.last, StickDemand{});
  }
  EXPECT_TRUE(output.killed());
}

TEST(OutputLoop, StaysStillBeforeTheFirstDemand) {
  RecordingTransmitter transmitter;
  OutputLoop output(transmitter);
  output.step(5000 * kMs);
  EXPECT_EQ(transmitter.last, StickDemand{});
  output.submit(kFlying, 5001 * kMs);
  output.step(5002 * kMs);
  EXPECT_EQ(transmitter.last, kFlying);
}

}  // namespace
}  // namespace helical
