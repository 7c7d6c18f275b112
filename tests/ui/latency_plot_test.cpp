// Counting only: painting is looked at in the pictures. Needs no display.

#include <gtest/gtest.h>

#include <memory>

#include "ui/tick_history.h"

namespace helical {
namespace {

EngineSnapshot tickWith(double time_s, std::uint64_t frames, double latency_ms) {
  EngineSnapshot tick;
  tick.time = fromSeconds(time_s);
  tick.camera_count = 1;
  tick.cameras[0].frames = frames;
  tick.cameras[0].latency = fromSeconds(1e-3 * latency_ms);
  return tick;
}

TEST(TickHistoryLatency, AFrameCountsAtTheTickThatFirstHasIt) {
  TickHistory history(1);
  history.add(tickWith(0.0, 1, 12.0));
  history.add(tickWith(0.1, 1, 12.0));
  history.add(tickWith(0.2, 2, 15.0));
  const int column = history.column(0, CameraColumn::kLatency);
  EXPECT_NEAR(history.value(0, column), 12.0, 1e-4);
  EXPECT_NE(history.value(1, column), history.value(1, column)) << "no new frame, no value";
  EXPECT_NEAR(history.value(2, column), 15.0, 1e-4);
}

}  // namespace
}  // namespace helical
