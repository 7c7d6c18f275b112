#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/experiment.h"
#include "app/progress.h"
#include "engine/base/error.h"
#include "engine/experiments/calibration_study.h"

namespace helical {
namespace {

using nlohmann::json;

struct Arguments {
  int runs = 200;
  std::uint64_t seed = 1;
  bool json = false;
};

json number(double value) {
  return std::isfinite(value) ? json(value) : json(nullptr);
}

json ratiosJson(const CalibrationResult& result,
                RatioInterval (CalibrationResult::*ratio)(std::size_t) const) {
  json fields;
  for (std::size_t mark = 0; mark < kStudyMarksS.size(); ++mark) {
    const RatioInterval interval = (result.*ratio)(mark);
    fields[std::to_string(static_cast<int>(kStudyMarksS[mark])) + "s"] = {
        {"value", number(interval.value)}, {"ci95", {number(interval.low), number(interval.high)}}};
  }
  return fields;
}

json conditionJson(const CalibrationResult& result) {
  const Proportion success = result.success();
  json nees;
  for (std::size_t mark = 0; mark < kStudyMarksS.size(); ++mark)
    nees[std::to_string(static_cast<int>(kStudyMarksS[mark])) + "s"] = number(result.meanNees(mark));
  return {
      {"name", result.condition.name},
      {"calibrator", result.condition.calibrator},
      {"rmse_over_crlb", ratiosJson(result, &CalibrationResult::positionRatio)},
      {"orientation_rmse_over_crlb", ratiosJson(result, &CalibrationResult::orientationRatio)},
      {"success", success.value},
      {"success_ci95", {success.low, success.high}},
      {"time_to_1cm_s",
       {{"median", number(result.convergedQuantile(0.5))}, {"p90", number(result.convergedQuantile(0.9))}}},
      {"nees", nees},
      {"nees_in_band", result.neesInBand()},
      {"step_us", {{"mean", result.meanStepUs()}, {"p999", result.slowStepUs()}}}};
}

std::string reportJson(const Arguments& arguments, const std::vector<CalibrationResult>& results) {
  json report{{"runs", arguments.runs}, {"seed", arguments.seed}, {"conditions", json::array()}};
  for (const auto& result : results) report["conditions"].push_back(conditionJson(result));
  return report.dump(2) + "\n";
}

std::string rowOf(const CalibrationResult& result) {
  char row[256];
  const RatioInterval early = result.positionRatio(0), middle = result.positionRatio(1),
                      late = result.positionRatio(2);
  std::snprintf(row, sizeof row,
                "%-23s %-24s %7.2f %7.2f %7.3f %6.3f-%.3f %8.3f %6.2f %6.2f %8.2f %-3s %7.1f %6.0f\n",
                result.condition.name.c_str(), result.condition.calibrator.c_str(), early.value, middle.value,
                late.value, late.low, late.high, result.success().value, result.convergedQuantile(0.5),
                result.convergedQuantile(0.9), result.meanNees(2), result.neesInBand() ? "yes" : "no",
                result.meanStepUs(), result.slowStepUs());
  return row;
}

std::string reportText(const Arguments& arguments, const std::vector<CalibrationResult>& results) {
  std::string text =
      "A camera calibrated in flight, over " + std::to_string(arguments.runs) +
      " flights of 13 s for each line; position error over its Cramer-Rao bound\n\n"
      "                                                 RMSE/CRLB at               95 %         within to 1 "
      "cm, "
      "0.5 deg  NEES in    us a frame\n"
      "flights                 method                       1 s     5 s    13 s     interval   1 cm    "
      "median    p90     at 13 s band   mean  99.9 %\n";
  for (const auto& result : results) text += rowOf(result);
  return text + "\nWithin 1 cm: and 0.5 degrees, at 13 s. NEES: 6 where the covariance is true.\n";
}

int runExperiment(const Arguments& arguments) {
  const auto conditions = calibrationConditions();
  std::vector<CalibrationResult> results;
  {
    Progress progress("Calibrating");
    for (const auto& condition : conditions)
      results.push_back(studyCalibration(condition, arguments.runs, arguments.seed, [&](int done) {
        const double share = static_cast<double>(done) / arguments.runs;
        progress.update(
            (static_cast<double>(results.size()) + share) / static_cast<double>(conditions.size()),
            condition.name + ", " + condition.calibrator);
      }));
  }
  const std::string report = arguments.json ? reportJson(arguments, results) : reportText(arguments, results);
  if (std::fputs(report.c_str(), stdout) < 0 || std::fflush(stdout) != 0)
    throw Error(ErrorKind::kSystem, "the report cannot be written to standard output", {},
                "check the disk or the pipe");
  return 0;
}

}  // namespace

void addCalibrationExperiment(CLI::App& experiments, int& exit_code) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = experiments.add_subcommand(
      "calibration", "A camera calibrated in flight: error over its Cramer-Rao bound, every method");
  command->add_option("--runs", arguments->runs, "Flights for each condition")
      ->check(CLI::Range(2, 1000000))
      ->capture_default_str();
  command->add_option("--seed", arguments->seed, "First seed of everything that is drawn at random")
      ->capture_default_str();
  command->add_flag("--json", arguments->json, "Print one JSON object");
  command->callback([arguments, &exit_code] { exit_code = runExperiment(*arguments); });
}

}  // namespace helical
