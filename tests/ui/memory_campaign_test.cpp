// Half an hour of the real window on the real engine, in real time.

#include <cstdlib>
#include <fstream>

#include "tests/ui/memory.h"
#include "tests/ui/window_fixture.h"

namespace helical {
namespace {

constexpr double kMinutes = 30.0;
constexpr double kMbAMinute = 1.0;
constexpr double kWarmUpS = 60.0;

using MemoryCampaign = WindowTest;

TEST_F(MemoryCampaign, ThirtyMinutesOfFlightCostLessThanAMegabyteEach) {
  RigConfig rig = shippedRig(true);
  rig.safety.flight_time_limit_s = 120.0 * kMinutes;  // it would land after ten minutes
  open(rig);
  ASSERT_NO_FATAL_FAILURE(takeOffByMouse());
  const auto flyFor = [this](double seconds) {
    const double end = toSeconds(snapshot().time) + seconds;
    return QTest::qWaitFor([&] { return toSeconds(snapshot().time) >= end; },
                           static_cast<int>(2e3 * seconds) + kPatienceMs);
  };
  ASSERT_TRUE(flyFor(kWarmUpS));
  const double before = ownMemoryMb();
  ASSERT_TRUE(flyFor(60.0 * kMinutes));
  const double rate = (ownMemoryMb() - before) / kMinutes;
  if (const char* folder = std::getenv("HELICAL_CAMPAIGNS"))
    std::ofstream(std::string(folder) + "/window_memory.json")
        << "{\"minutes\": " << kMinutes << ", \"mb_a_minute\": " << rate << "}\n";
  EXPECT_LT(rate, kMbAMinute);
  EXPECT_EQ(snapshot().phase, FlightPhase::kFlying);
}

}  // namespace
}  // namespace helical
