// A thousand flights with faults; leaves its JSON in build/*/campaigns.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "engine/config/plan_file.h"
#include "engine/config/resource_files.h"
#include "engine/config/rig_file.h"
#include "engine/experiments/fault_study.h"

namespace helical {
namespace {

constexpr int kFlights = 1000;

nlohmann::json number(double value) {
  return std::isfinite(value) ? nlohmann::json(value) : nlohmann::json(nullptr);
}

void leaveReport(const FaultStudy& study) {
  nlohmann::json report{{"runs", kFlights},
                        {"breaches", study.breaches},
                        {"hard_landings", study.hard_landings},
                        {"bad_armings", study.bad_armings}};
  for (const FaultRow& row : study.rows())
    report["faults"].push_back({{"name", toString(row.kind)},
                                {"counted", row.counted},
                                {"missed", row.missed},
                                {"median_s", number(row.median_s)},
                                {"longest_s", number(row.longest_s)},
                                {"limit_s", number(detectionLimit(row.kind))},
                                {"worst_seed", row.worst_seed}});
  std::printf("%s\n", report.dump().c_str());
  const char* asked = std::getenv("HELICAL_CAMPAIGNS");
  const std::filesystem::path folder = asked != nullptr ? asked : HELICAL_REPORT_DIR;
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "faults.json") << report.dump(2) << "\n";
}

TEST(FaultCampaign, OfAThousandFlights) {
  const RigConfig rig = loadRig(resourceFolder() / "rigs" / "calibrated.toml");
  FlightPlan plan = loadPlan(planPath("hover"));
  plan.land_at_s = 13.0;
  const FaultStudy study = studyFaults(rig, plan, kFlights, 1, [](int) {});
  leaveReport(study);
  EXPECT_TRUE(study.bad_armings.empty());
  EXPECT_TRUE(study.breaches.empty());
  EXPECT_TRUE(study.hard_landings.empty());
}

}  // namespace
}  // namespace helical
