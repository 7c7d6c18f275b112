#include "app/calibration_report.h"

#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

namespace helical {
namespace {

using nlohmann::json;

constexpr double kMegabyte = 1024.0 * 1024.0;

json number(double value) {
  return std::isfinite(value) ? json(value) : json(nullptr);
}

json intervalJson(const Interval& interval) {
  return {{"value", number(interval.value)}, {"ci95", {number(interval.low), number(interval.high)}}};
}

json shareJson(const Proportion& share) {
  return {{"value", share.value}, {"ci95", {share.low, share.high}}};
}

/// Median and p90 as numbers, with their intervals beside them.
json timesJson(const Interval& median, const Interval& p90) {
  return {{"median", number(median.value)},
          {"median_ci95", {number(median.low), number(median.high)}},
          {"p90", number(p90.value)},
          {"p90_ci95", {number(p90.low), number(p90.high)}}};
}

/// All keys that every condition has: missing values are null, never left out.
json emptyCondition(const std::string& name) {
  json condition{{"name", name}, {"calibrator", "joint"}};
  for (const char* key : {"rmse_over_crlb", "orientation_rmse_over_crlb",
                          "rmse_over_crlb_of_true_centroids", "success", "success_ci95", "time_to_1cm_s",
                          "nees", "nees_in_band", "step_us"})
    condition[key] = nullptr;
  return condition;
}

std::string markName(std::size_t mark) {
  return std::to_string(static_cast<int>(kStudyMarksS[mark])) + "s";
}

json ratiosJson(const CalibrationResult& result, Interval (CalibrationResult::*ratio)(std::size_t) const) {
  json fields;
  for (std::size_t mark = 0; mark < kStudyMarksS.size(); ++mark)
    fields[markName(mark)] = intervalJson((result.*ratio)(mark));
  return fields;
}

json conditionJson(const CalibrationResult& result) {
  json condition = emptyCondition(result.condition.name);
  const Proportion success = result.success();
  json nees;
  for (std::size_t mark = 0; mark < kStudyMarksS.size(); ++mark)
    nees[markName(mark)] = number(result.meanNees(mark));
  condition["calibrator"] = result.condition.calibrator;
  condition["rmse_over_crlb"] = ratiosJson(result, &CalibrationResult::positionRatio);
  condition["orientation_rmse_over_crlb"] = ratiosJson(result, &CalibrationResult::orientationRatio);
  condition["rmse_over_crlb_of_true_centroids"] = ratiosJson(result, &CalibrationResult::positionOverTrueBound);
  condition["success"] = success.value;
  condition["success_ci95"] = {success.low, success.high};
  condition["time_to_1cm_s"] = timesJson(result.convergedQuantile(0.5), result.convergedQuantile(0.9));
  condition["nees"] = nees;
  condition["nees_in_band"] = result.neesInBand();
  condition["step_us"] = {{"mean", result.meanStepUs()}, {"p999", result.slowStepUs()}};
  return condition;
}

json knockJson(const KnockResult& result) {
  json condition = emptyCondition(result.condition.name);
  condition["runs"] = result.runs.size();
  condition["found_within_s"] = result.condition.limit_s;
  condition["found_in_time"] = shareJson(result.foundInTime());
  condition["found_s"] = timesJson(result.foundQuantile(0.5), result.foundQuantile(0.9));
  condition["back_within_1cm_s"] = timesJson(result.backQuantile(0.5), result.backQuantile(0.9));
  condition["in_control_again_s"] = timesJson(result.againQuantile(0.5), result.againQuantile(0.9));
  condition["wrong_alarms"] = result.othersFound();
  return condition;
}

json quietJson(const QuietCondition& quiet, const QuietResult& result) {
  json condition = emptyCondition(quiet.name);
  condition["runs"] = quiet.minutes;
  condition["camera_hours"] = result.camera_hours;
  condition["false_alarms"] = result.alarms;
  return condition;
}

json sixteenJson(const ManyCamerasResult& result) {
  json condition = emptyCondition("sixteen-cameras");
  condition["cameras"] = result.cameras;
  condition["frames"] = result.frames;
  condition["frame_us"] = {{"mean", result.mean_us}, {"p999", result.slow_us}};
  return condition;
}

json memoryJson(const MemoryResult& result) {
  json condition = emptyCondition("memory");
  condition["flown_s"] = result.flown_s;
  condition["memory_bytes"] = {
      {"after_60s", result.after_a_minute}, {"end", result.at_the_end}, {"most", result.most}};
  return condition;
}

template <typename... Values>
std::string formatted(const char* format, Values... values) {
  char line[320];
  std::snprintf(line, sizeof line, format, values...);
  return line;
}

std::string rowOf(const CalibrationResult& result) {
  const Interval early = result.positionRatio(0), middle = result.positionRatio(1), late = result.positionRatio(2);
  const Proportion success = result.success();
  return formatted(
      "%-33s %-23s %5.2f (%4.2f-%4.2f) %5.2f (%4.2f-%4.2f) %5.2f (%4.2f-%4.2f) %6.3f (%5.3f-) %5.2f %5.2f %6.2f "
      "%-3s %6.1f %5.0f\n",
      result.condition.name.c_str(), result.condition.calibrator.c_str(), early.value, early.low, early.high,
      middle.value, middle.low, middle.high, late.value, late.low, late.high, success.value, success.low,
      result.convergedQuantile(0.5).value, result.convergedQuantile(0.9).value, result.meanNees(2),
      result.neesInBand() ? "yes" : "no", result.meanStepUs(), result.slowStepUs());
}

std::string rowOf(const KnockResult& result) {
  const Proportion found = result.foundInTime();
  return formatted("%-16s %5.2f s %6.3f (%5.3f-%5.3f) %6.2f %6.2f %8.2f %6.2f %8.2f %6.2f %8d\n",
                   result.condition.name.c_str(), result.condition.limit_s, found.value, found.low, found.high,
                   result.foundQuantile(0.5).value, result.foundQuantile(0.9).value,
                   result.backQuantile(0.5).value, result.backQuantile(0.9).value, result.againQuantile(0.5).value,
                   result.againQuantile(0.9).value, result.othersFound());
}

}  // namespace

std::string calibrationReportJson(const CalibrationReport& report) {
  json all{{"runs", report.runs}, {"seed", report.seed}, {"conditions", json::array()}};
  json& conditions = all["conditions"];
  for (const auto& result : report.conditions) conditions.push_back(conditionJson(result));
  for (const auto& result : report.knocks) conditions.push_back(knockJson(result));
  for (const auto& [condition, result] : report.quiet) conditions.push_back(quietJson(condition, result));
  if (report.sixteen) conditions.push_back(sixteenJson(*report.sixteen));
  if (report.memory) conditions.push_back(memoryJson(*report.memory));
  return all.dump(2) + "\n";
}

std::string calibrationReportText(const CalibrationReport& report) {
  std::string text;
  if (!report.conditions.empty()) {
    text +=
        "A camera calibrated in flight, over " + std::to_string(report.runs) +
        " flights of 13 s for each line; position error over its Cramer-Rao bound,\nwith 95 % intervals\n\n" +
        formatted("%-33s %-23s %17s %17s %17s %14s %11s %10s %14s\n", "", "", "RMSE/CRLB at", "", "",
                  "within 1 cm,", "s to 1 cm,", "NEES in", "us a frame") +
        formatted("%-33s %-23s %17s %17s %17s %14s %5s %5s %6s %-3s %6s %5s\n", "flights", "method", "1 s",
                  "5 s", "13 s", "0.5 degrees", "half", "p90", "13 s", "band", "mean", "99.9%");
    for (const auto& result : report.conditions) text += rowOf(result);
    text += "\nWithin 1 cm: and 0.5 degrees, at 13 s. NEES: 6 where the covariance is true.\n";
  }
  if (!report.knocks.empty()) {
    text +=
        "\nOne camera of three in control is knocked (small knocks about an axis across the line of sight); "
        "seconds after it\n"
        "                           found within           found           within 1 cm for good   in again   "
        "   alarms of\n"
        "knock            limit         (95 %)         median    p90   median    p90   median    p90   "
        "others\n";
    for (const auto& result : report.knocks) text += rowOf(result);
  }
  for (const auto& [condition, result] : report.quiet)
    text += formatted("\n%s: %d false alarms in %.1f camera-hours with %.0f %% of the centroids thrown aside\n",
                      condition.name.c_str(), result.alarms, result.camera_hours, 100.0 * condition.outliers);
  if (report.sixteen)
    text += formatted("\nsixteen-cameras: %.0f us mean, %.0f us at the 99.9th percentile for one frame of all %d\n",
                      report.sixteen->mean_us, report.sixteen->slow_us, report.sixteen->cameras);
  if (report.memory)
    text += formatted("\nmemory: %.3f MB in use after a minute, %.3f at most, %.3f after %.0f s of flight\n",
                      report.memory->after_a_minute / kMegabyte, report.memory->most / kMegabyte,
                      report.memory->at_the_end / kMegabyte, report.memory->flown_s);
  return text;
}

}  // namespace helical
