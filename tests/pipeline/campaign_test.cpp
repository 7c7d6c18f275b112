// The figures of the README, over a hundred image-free flights each. Each leaves its JSON in
// build/*/campaigns.

#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <filesystem>
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
  int brought_down = 0;  ///< by the no-pose failsafe, at rest on the ground
  int hard_touches_while_seen = 0;
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
  std::vector<double> touch, height, yaw;
  nlohmann::json report = {{"name", name}, {"runs", kSeeds}, {"not_landed", nlohmann::json::array()}};
  for (std::size_t i = 0; i < flights.size(); ++i) {
    const Flown& flown = flights[i];
    campaign.landed += flown.outcome == "landed";
    campaign.brought_down += flown.outcome == "failsafe-landed";
    campaign.hard_touches_while_seen += flown.hard_touch_while_seen;
    touch.push_back(flown.verdict.hardest_touch);
    if (flown.score.hoverHorizontal().count() > 0)
      campaign.hover_m.push_back(flown.score.hoverHorizontal().value());
    campaign.nees.push_back(flown.score.nees());
    if (flown.score.hoverHeight().count() > 0) {
      height.push_back(flown.score.hoverHeight().value());
      yaw.push_back(toDegrees(flown.score.hoverYaw().value()));
    }
    if (flown.outcome != "landed")
      report["not_landed"].push_back({{"seed", i + 1}, {"outcome", flown.outcome}});
  }
  report["landed"] = campaign.landed;
  report["hover_median_m"] = test::median(campaign.hover_m);
  report["hover_p90_m"] = test::percentile(campaign.hover_m, 0.9);
  report["height_median_m"] = test::median(height);
  report["yaw_median_deg"] = test::median(yaw);
  report["touchdown_median_m_s"] = test::median(touch);
  report["touchdown_worst_m_s"] = test::percentile(touch, 1.0);
  report["nees_mean"] = std::accumulate(campaign.nees.begin(), campaign.nees.end(), 0.0) / kSeeds;
  std::printf("%s\n", report.dump().c_str());
  const char* asked = std::getenv("HELICAL_CAMPAIGNS");
  const std::filesystem::path folder = asked != nullptr ? asked : HELICAL_REPORT_DIR;
  std::filesystem::create_directories(folder);
  std::ofstream(folder / (std::string(name) + ".json")) << report.dump(2) << "\n";
  return campaign;
}

/// 95 % band of the mean of 100 chi-squares of 6 degrees of freedom.
void expectTrueCovariance(const Campaign& campaign) {
  const double nees = std::accumulate(campaign.nees.begin(), campaign.nees.end(), 0.0) / kSeeds;
  EXPECT_GT(nees, 5.34);
  EXPECT_LT(nees, 6.70);
}

RigConfig covered(const char* rig_name, std::uint64_t seed, const std::vector<int>& cameras, double to_s) {
  RigConfig rig = test::shippedRig(rig_name, seed);
  test::cover(rig, cameras, 13.0, to_s);
  return rig;
}

RigConfig variedRig(RigConfig rig) {
  rig.simulation.vary = 0.3;
  return rig;
}

TEST(Campaign, StillAir) {
  const Campaign campaign = fly("still_air", [](std::uint64_t seed) {
    RigConfig rig = test::shippedRig("paper", seed);
    rig.simulation.gust_factor = 0.0;
    return rig;
  });
  EXPECT_EQ(campaign.landed, kSeeds);
  EXPECT_LE(test::median(campaign.hover_m), 0.010);
}

TEST(Campaign, Gusts) {
  const Campaign campaign = fly("gusts", [](std::uint64_t seed) { return test::shippedRig("paper", seed); });
  EXPECT_EQ(campaign.landed, kSeeds);
  EXPECT_LE(test::percentile(campaign.hover_m, 0.9), 0.040);
}

TEST(Campaign, GustsAndUnknownParameters) {
  const Campaign campaign =
      fly("gusts_varied", [](std::uint64_t seed) { return variedRig(test::shippedRig("paper", seed)); });
  EXPECT_GE(campaign.landed, 98);
  EXPECT_LE(test::percentile(campaign.hover_m, 0.9), 0.060);
  expectTrueCovariance(campaign);
}

TEST(Campaign, CameraTwoCovered) {
  const Campaign campaign =
      fly("camera_2_covered", [](std::uint64_t seed) { return covered("calibrated", seed, {1}, 60.0); });
  EXPECT_EQ(campaign.landed, kSeeds);
}

TEST(Campaign, EveryCameraCoveredForHalfASecond) {
  const Campaign campaign = fly("all_covered_half_second", [](std::uint64_t seed) {
    return covered("paper", seed, {0, 1, 2}, 13.5);
  });
  EXPECT_GE(campaign.landed, 98);
}

TEST(Campaign, EveryCameraCoveredForASecond) {
  const Campaign campaign = fly("all_covered_one_second", [](std::uint64_t seed) {
    return covered("paper", seed, {0, 1, 2}, 14.0);
  });
  EXPECT_GE(campaign.landed, 95);
}

TEST(Campaign, EveryCameraCoveredForASecondWithUnknownParameters) {
  const Campaign campaign = fly("all_covered_one_second_varied", [](std::uint64_t seed) {
    return variedRig(covered("paper", seed, {0, 1, 2}, 14.0));
  });
  EXPECT_GE(campaign.landed, 95);
}

TEST(Campaign, EveryCameraCoveredForGood) {
  const Campaign campaign = fly("all_covered_for_good", [](std::uint64_t seed) {
    return covered("paper", seed, {0, 1, 2}, 100.0);
  });
  EXPECT_EQ(campaign.brought_down, kSeeds);
  EXPECT_EQ(campaign.hard_touches_while_seen, 0);
}

}  // namespace
}  // namespace helical
