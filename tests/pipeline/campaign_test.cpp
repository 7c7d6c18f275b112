// The figures of the README, over a hundred image-free flights each; their JSON goes to $HELICAL_CAMPAIGNS if that is
// set.

#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <numeric>
#include <thread>

#include "engine/geometry/rotation.h"
#include "tests/pipeline/flight_fixture.h"

namespace helical {
namespace {

using test::Flown;

constexpr int kSeeds = 100;

struct Campaign {
  int landed = 0;
  int soft = 0;  ///< landed, or brought down by a failsafe without a hard touch while there was a pose
  std::vector<double> hover_m;
  std::vector<double> nees;
};

Campaign fly(const char* name, const std::function<RigConfig(std::uint64_t)>& rig_for) {
  std::vector<Flown> flights(kSeeds);
  std::atomic<int> next{0};
  std::vector<std::jthread> workers;
  for (unsigned w = 0; w < std::max(1u, std::thread::hardware_concurrency()); ++w)
    workers.emplace_back([&] {
      for (int i = next++; i < kSeeds; i = next++)
        flights[static_cast<std::size_t>(i)] = test::flyHover(rig_for(static_cast<std::uint64_t>(i + 1)));
    });
  workers.clear();

  Campaign campaign;
  nlohmann::json report = {{"name", name}, {"runs", kSeeds}, {"not_landed", nlohmann::json::array()}};
  for (std::size_t i = 0; i < flights.size(); ++i) {
    const Flown& flown = flights[i];
    campaign.landed += flown.outcome == "landed";
    campaign.soft += !flown.hard_touch_while_seen;
    if (flown.score.hoverHorizontal().count() > 0)
      campaign.hover_m.push_back(flown.score.hoverHorizontal().value());
    campaign.nees.push_back(flown.score.nees());
    if (flown.outcome != "landed")
      report["not_landed"].push_back({{"seed", i + 1}, {"outcome", flown.outcome}});
  }
  report["landed"] = campaign.landed;
  report["hover_median_m"] = test::median(campaign.hover_m);
  report["hover_p90_m"] = test::percentile(campaign.hover_m, 0.9);
  report["nees_mean"] = std::accumulate(campaign.nees.begin(), campaign.nees.end(), 0.0) / kSeeds;
  std::printf("%s\n", report.dump().c_str());
  if (const char* folder = std::getenv("HELICAL_CAMPAIGNS"))
    std::ofstream(std::string(folder) + "/" + name + ".json") << report.dump(2) << "\n";
  return campaign;
}

TEST(Campaign, GustsAndUnknownParameters) {
  const Campaign campaign = fly("hover_varied", [](std::uint64_t seed) {
    RigConfig rig = test::shippedRig("paper", seed);
    rig.simulation.vary = 0.3;
    return rig;
  });
  EXPECT_GE(campaign.landed, 98);
  EXPECT_LE(test::percentile(campaign.hover_m, 0.9), 0.060);
  // 95 % band of the mean of 100 chi-squares of 6 degrees of freedom.
  const double nees = std::accumulate(campaign.nees.begin(), campaign.nees.end(), 0.0) / kSeeds;
  EXPECT_GT(nees, 5.34);
  EXPECT_LT(nees, 6.70);
}

TEST(Campaign, CameraTwoCovered) {
  EXPECT_EQ(fly("camera_2_covered",
                [](std::uint64_t seed) {
                  RigConfig rig = test::shippedRig("calibrated", seed);
                  test::cover(rig, {1}, 13.0, 60.0);
                  return rig;
                })
                .landed,
            kSeeds);
}

TEST(Campaign, EveryCameraCoveredForHalfASecond) {
  EXPECT_GE(fly("all_covered_half_second",
                [](std::uint64_t seed) {
                  RigConfig rig = test::shippedRig("paper", seed);
                  test::cover(rig, {0, 1, 2}, 13.0, 13.5);
                  return rig;
                })
                .landed,
            98);
}

TEST(Campaign, EveryCameraCoveredForASecond) {
  EXPECT_GE(fly("all_covered_one_second",
                [](std::uint64_t seed) {
                  RigConfig rig = test::shippedRig("paper", seed);
                  test::cover(rig, {0, 1, 2}, 13.0, 14.0);
                  return rig;
                })
                .landed,
            95);
}

TEST(Campaign, EveryCameraCoveredForGood) {
  EXPECT_EQ(fly("all_covered_for_good",
                [](std::uint64_t seed) {
                  RigConfig rig = test::shippedRig("paper", seed);
                  test::cover(rig, {0, 1, 2}, 13.0, 100.0);
                  return rig;
                })
                .soft,
            kSeeds);
}

}  // namespace
}  // namespace helical
