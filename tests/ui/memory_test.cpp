// An hour of supervision must not cost more memory than a minute.

#include <QTest>

#include "tests/ui/hurried_flight.h"
#include "tests/ui/memory.h"
#include "tests/ui/window_fixture.h"

namespace helical {
namespace {

constexpr double kMbAMinute = 1.0;
constexpr double kPictureMb = 3.2;  // of the window, to the screen
constexpr int kTicksAPoll = 12;

class Memory : public WindowTest {
 protected:
  void watch(FlightView& flight) {
    window_ = std::make_unique<MainWindow>(flight.rig(), WindowOptions{});
    window_->fitToScreen();
    window_->show();
    ASSERT_TRUE(QTest::qWaitForWindowExposed(window_.get(), kPatienceMs));
    window_->watch(flight);
  }
};

TEST_F(Memory, ThreeMinutesOfFlightCostLessThanAMegabyteEach) {
  MemoryLooks::keepLargeBlocksApart();
  RigConfig rig = shippedRig(false);
  FlightPlan plan = hoverWithoutEnd();
  HurriedFlight flight(rig, plan, kTicksAPoll);
  ASSERT_NO_FATAL_FAILURE(watch(flight));
  const auto flyTo = [&](double seconds) {
    return eventually([&] { return toSeconds(flight.snapshot().time) >= seconds; });
  };
  const auto looksFrom = [&](double seconds) {
    MemoryLooks looks;
    for (int look = 0; look < 16; ++look) {
      EXPECT_TRUE(flyTo(seconds + 2.0 * look));
      looks.look();
    }
    return looks;
  };
  const MemoryLooks before = looksFrom(40.0);  // when every part of the window has been drawn
  ASSERT_EQ(flight.snapshot().phase, FlightPhase::kFlying);
  ASSERT_GT(before.allocatedMb(), 20.0);
  const MemoryLooks after = looksFrom(220.0);
  EXPECT_EQ(flight.snapshot().phase, FlightPhase::kFlying);
  EXPECT_LT(after.allocatedMb() - before.allocatedMb(), 3.0 * kMbAMinute);
  EXPECT_LT(after.allMb() - before.allMb(), 3.0 * kMbAMinute + 2.0 * kPictureMb);
  window_->detach();
  window_.reset();
}

}  // namespace
}  // namespace helical
