// An hour of supervision must not cost more memory than a minute.

#include <QTest>
#include <algorithm>
#include <limits>

#include "tests/ui/hurried_flight.h"
#include "tests/ui/memory.h"
#include "tests/ui/window_fixture.h"

namespace helical {
namespace {

constexpr double kMbAMinute = 1.0;
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
  RigConfig rig = shippedRig(false);
  FlightPlan plan = hoverWithoutEnd();
  HurriedFlight flight(rig, plan, kTicksAPoll);
  ASSERT_NO_FATAL_FAILURE(watch(flight));
  const auto flyTo = [&](double seconds) {
    return eventually([&] { return toSeconds(flight.snapshot().time) >= seconds; });
  };
  // The least of several looks: one more or less of the pictures on their way to the screen is 3 MB.
  const auto leastFrom = [&](double seconds) {
    double least = std::numeric_limits<double>::infinity();
    for (int look = 0; look < 8; ++look) {
      EXPECT_TRUE(flyTo(seconds + 3.0 * look));
      least = std::min(least, ownMemoryMb());
    }
    return least;
  };
  const double before = leastFrom(40.0);  // when every part of the window has been drawn
  ASSERT_EQ(flight.snapshot().phase, FlightPhase::kFlying);
  ASSERT_GT(before, 20.0);
  const double after = leastFrom(220.0);
  EXPECT_EQ(flight.snapshot().phase, FlightPhase::kFlying);
  EXPECT_LT(after - before, 3.0 * kMbAMinute);
  window_->detach();
  window_.reset();
}

}  // namespace
}  // namespace helical
