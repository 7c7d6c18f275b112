// The paper's experiments at few runs, image-free.

#include "engine/experiments/matsukawa2010.h"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/config/plan_file.h"
#include "engine/config/resource_files.h"
#include "engine/config/rig_file.h"

namespace helical {
namespace {

constexpr int kRuns = 4;

class Matsukawa2010 : public testing::Test {
 protected:
  static std::vector<MatsukawaResult> fly(int runs) {
    const MatsukawaOptions options{runs, 1, false};
    return flyMatsukawa2010(loadRig(resourceFolder() / "rigs" / "paper.toml"), loadPlan(planPath("hover")),
                            options, [](double, const std::string&) {});
  }
  static void SetUpTestSuite() { results_ = new std::vector<MatsukawaResult>(fly(kRuns)); }
  static void TearDownTestSuite() {
    delete results_;
    results_ = nullptr;
  }
  static const MatsukawaResult& arm(const std::string& tracker, const std::string& name) {
    for (const auto& result : *results_)
      if (result.arm.tracker == tracker && result.arm.name == name) return result;
    throw std::out_of_range(tracker + " " + name);
  }
  static std::vector<MatsukawaResult>* results_;
};
std::vector<MatsukawaResult>* Matsukawa2010::results_ = nullptr;

TEST_F(Matsukawa2010, FliesFourArmsWithBothTrackers) {
  EXPECT_EQ(results_->size(), 8u);
  for (const auto& result : *results_) {
    ASSERT_EQ(result.flights.size(), static_cast<std::size_t>(kRuns));
    for (std::size_t i = 0; i < result.flights.size(); ++i) EXPECT_EQ(result.flights[i].seed, i + 1);
  }
}

TEST_F(Matsukawa2010, ExperimentBLandsOnACalibrationOfSomeMillimetres) {
  for (const char* tracker : {"paper", "helical"}) {
    const MatsukawaResult& b = arm(tracker, "B");
    EXPECT_GE(b.landed(), kRuns - 1) << tracker;
    EXPECT_GT(b.camera3UsedShare(), 0.5) << tracker;
    EXPECT_LT(b.spread(&MatsukawaFlight::camera3_error_m).median, 0.01) << tracker;
  }
}

TEST_F(Matsukawa2010, ExperimentAKnowsCamera3Worse) {
  for (const char* tracker : {"paper", "helical"})
    EXPECT_GT(arm(tracker, "A").spread(&MatsukawaFlight::camera3_error_m).median,
              arm(tracker, "B").spread(&MatsukawaFlight::camera3_error_m).median)
        << tracker;
}

TEST_F(Matsukawa2010, Camera1AloneHasNoCamera3) {
  const MatsukawaResult& alone = arm("helical", "camera-1-alone");
  EXPECT_EQ(alone.camera3UsedShare(), 0.0);
  EXPECT_TRUE(std::isnan(alone.spread(&MatsukawaFlight::camera3_error_m).median));
}

TEST_F(Matsukawa2010, LearningGoesOnWithThePapersTracker) {
  const MatsukawaFlight& flight = arm("paper", "B").flights[0];
  EXPECT_NE(flight.camera3_end_error_m, flight.camera3_error_m);
}

TEST_F(Matsukawa2010, TracesTheFirstSeed) {
  const FlightTrace& trace = arm("helical", "B").trace;
  EXPECT_EQ(trace.name, "experiment B");
  EXPECT_EQ(trace.camera_count, 3);
  EXPECT_EQ(trace.marker_count, 4);
  EXPECT_EQ(trace.covered_camera, 1);
  EXPECT_EQ(trace.covered_from_s, 13.0);
  EXPECT_FALSE(trace.crashed);
  ASSERT_GT(trace.samples.size(), 1000u);
  const auto at = [&](double time_s) {
    return *std::find_if(trace.samples.begin(), trace.samples.end(),
                         [&](const TraceSample& sample) { return sample.time_s >= time_s; });
  };
  EXPECT_NEAR(trace.samples.front().camera_position_error.norm(), 0.4, 0.05);
  EXPECT_NEAR(trace.samples.front().camera_rotation_error.norm(), 0.2618, 0.03);
  EXPECT_NEAR(at(12.0).position.z(), 0.6, 0.05);
  EXPECT_NEAR(at(12.0).reference.z(), 0.6, 1e-9);
  EXPECT_NE(at(12.0).selected[1], 0);
  EXPECT_EQ(at(15.0).selected[1], 0);  // covered
  EXPECT_NE(at(15.0).selected[2], 0);
}

TEST_F(Matsukawa2010, RepeatsForASeed) {
  const auto again = fly(1);
  for (std::size_t i = 0; i < again.size(); ++i) {
    const MatsukawaFlight &one = (*results_)[i].flights[0], &two = again[i].flights[0];
    EXPECT_EQ(one.outcome, two.outcome);
    EXPECT_EQ(one.pose_rms_after_cover, two.pose_rms_after_cover);
  }
}

}  // namespace
}  // namespace helical
