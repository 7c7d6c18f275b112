#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/experiment.h"
#include "app/progress.h"
#include "engine/base/error.h"
#include "engine/config/plan_file.h"
#include "engine/config/resource_files.h"
#include "engine/config/rig_file.h"
#include "engine/experiments/matsukawa2010.h"
#include "engine/geometry/rotation.h"
#ifdef HELICAL_HAS_WINDOW
#include "ui/figures/paper_figures.h"
#endif

namespace helical {
namespace {

using nlohmann::json;

struct Arguments {
  MatsukawaOptions options;
  bool no_images = false;
  bool json = false;
  std::string out;
};

json number(double value, double scale = 1.0) {
  return std::isfinite(value) ? json(scale * value) : json(nullptr);
}

json spreadJson(const MatsukawaResult& result, double MatsukawaFlight::*figure, double scale = 1.0) {
  const Spread spread = result.spread(figure);
  return {{"median", number(spread.median, scale)}, {"p90", number(spread.p90, scale)}};
}

json armJson(const MatsukawaResult& result) {
  const Proportion landed = result.landedShare();
  json outcomes = json::object();
  for (const MatsukawaFlight& flight : result.flights)
    outcomes[flight.outcome] = outcomes.value(flight.outcome, 0) + 1;
  return {{"name", result.arm.name},
          {"tracker", result.arm.tracker},
          {"calibrator", result.arm.calibrator.empty() ? json(nullptr) : json(result.arm.calibrator)},
          {"learns_from_own_pose", result.arm.tracker == "paper"},
          {"landed", result.landed()},
          {"rate", landed.value},
          {"ci95", {landed.low, landed.high}},
          {"outcomes", outcomes},
          {"pose_rms_after_13s_m", spreadJson(result, &MatsukawaFlight::pose_rms_after_cover)},
          {"camera3_used_after_13s", result.camera3UsedShare()},
          {"camera3_error_m", spreadJson(result, &MatsukawaFlight::camera3_error_m)},
          {"camera3_error_deg", spreadJson(result, &MatsukawaFlight::camera3_error, toDegrees(1.0))},
          {"camera3_end_error_m", spreadJson(result, &MatsukawaFlight::camera3_end_error_m)},
          {"camera3_end_error_deg", spreadJson(result, &MatsukawaFlight::camera3_end_error, toDegrees(1.0))}};
}

std::string reportJson(const Arguments& arguments, const std::vector<MatsukawaResult>& results) {
  json report{{"runs", arguments.options.runs},
              {"seed", arguments.options.seed},
              {"images", arguments.options.images}};
  for (const auto& result : results) report["arms"].push_back(armJson(result));
  return report.dump(2) + "\n";
}

std::string cell(const char* format, double value, int width) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, format, value);
  const std::string text = std::isfinite(value) ? buffer : "-";
  return std::string(static_cast<std::size_t>(std::max(1, width - static_cast<int>(text.size()))), ' ') +
         text;
}

std::string rowOf(const MatsukawaResult& result) {
  const Proportion landed = result.landedShare();
  const Spread pose = result.spread(&MatsukawaFlight::pose_rms_after_cover);
  const Spread metres = result.spread(&MatsukawaFlight::camera3_error_m);
  const Spread angle = result.spread(&MatsukawaFlight::camera3_error);
  char name[64];
  std::snprintf(name, sizeof name, "%-8s %-15s %-16s", result.arm.tracker.c_str(), result.arm.name.c_str(),
                result.arm.calibrator.empty() ? "-" : result.arm.calibrator.c_str());
  return name + cell("%.0f", result.landed(), 5) + cell("%.0f", 100.0 * landed.low, 6) + " -" +
         cell("%.0f %%", 100.0 * landed.high, 6) + cell("%.1f", 1e3 * pose.median, 9) +
         cell("%.1f", 1e3 * pose.p90, 8) + cell("%.0f %%", 100.0 * result.camera3UsedShare(), 8) +
         cell("%.1f", 1e3 * metres.median, 9) + cell("%.1f", 1e3 * metres.p90, 8) +
         cell("%.2f", toDegrees(angle.median), 7) + cell("%.2f", toDegrees(angle.p90), 7) + "\n";
}

std::string reportText(const Arguments& arguments, const std::vector<MatsukawaResult>& results) {
  std::string text = "Camera 2 covered from 13 s to the landing, camera 3 calibrated in flight: " +
                     std::to_string(arguments.options.runs) +
                     (arguments.options.images ? " flights with" : " flights without") +
                     " images an arm\n\n"
                     "                                          landed   95 %      pose, mm after 13 s   "
                     "camera 3  camera 3 at 13 "
                     "s: mm    degrees\n"
                     "tracker  arm             calibrator           of interval      median     p90     used "
                     "   median     p90 "
                     "median    p90\n";
  for (const auto& result : results) text += rowOf(result);
  return text +
         "\nWith the paper's tracker camera 3 goes on learning after 13 s from the pose that it helps to "
         "find, as the "
         "paper's does;\nwith ours only from a pose that others vouch for.\n";
}

void writeText(const std::filesystem::path& file, const std::string& text) {
  std::ofstream stream(file);
  stream << text;
  stream.close();
  if (!stream)
    throw Error(ErrorKind::kInput, "the results cannot be written", file.string(),
                "choose a folder that can be written to");
}

std::string flightsCsv(const std::vector<MatsukawaResult>& results) {
  std::string csv =
      "tracker,arm,calibrator,seed,outcome,pose_rms_after_13s_m,camera3_frames,camera3_used,camera3_error_m,"
      "camera3_error_deg,camera3_end_error_m,camera3_end_error_deg\n";
  char line[256];
  for (const auto& result : results)
    for (const auto& flight : result.flights) {
      std::snprintf(line, sizeof line, "%s,%s,%s,%llu,%s,%.6g,%llu,%llu,%.6g,%.6g,%.6g,%.6g\n",
                    result.arm.tracker.c_str(), result.arm.name.c_str(), result.arm.calibrator.c_str(),
                    static_cast<unsigned long long>(flight.seed), flight.outcome.c_str(),
                    flight.pose_rms_after_cover, static_cast<unsigned long long>(flight.camera3_frames),
                    static_cast<unsigned long long>(flight.camera3_used), flight.camera3_error_m,
                    toDegrees(flight.camera3_error), flight.camera3_end_error_m,
                    toDegrees(flight.camera3_end_error));
      csv += line;
    }
  return csv;
}

std::filesystem::path makeFolder(const std::string& name) {
  std::error_code failure;
  std::filesystem::create_directories(name, failure);
  if (failure)
    throw Error(ErrorKind::kInput, "the folder for the results cannot be made: " + failure.message(), name,
                "choose a folder that can be written to");
  return name;
}

void requireFigures(const Arguments& arguments) {
#ifdef HELICAL_HAS_WINDOW
  (void)arguments;
#else
  if (!arguments.out.empty())
    throw Error(ErrorKind::kInput, "--out needs figures, and this build draws none", {},
                "leave --out away, or build with Qt 6 (HELICAL_WITH_UI=ON)");
#endif
}

#ifdef HELICAL_HAS_WINDOW
const MatsukawaResult& armOf(const std::vector<MatsukawaResult>& results, const std::string& tracker,
                             const std::string& name) {
  return *std::find_if(results.begin(), results.end(), [&](const MatsukawaResult& result) {
    return result.arm.tracker == tracker && result.arm.name == name;
  });
}
#endif

/// Figures 6 to 11 of the first seed for each tracker, every flight, the report.
void writeResults(const Arguments& arguments, const std::vector<MatsukawaResult>& results) {
  const std::filesystem::path folder = makeFolder(arguments.out);
  writeText(folder / "matsukawa2010.json", reportJson(arguments, results));
  writeText(folder / "matsukawa2010.txt", reportText(arguments, results));
  writeText(folder / "flights.csv", flightsCsv(results));
#ifdef HELICAL_HAS_WINDOW
  for (const char* tracker : {"paper", "helical"})
    writePaperFigures(armOf(results, tracker, "A").trace, armOf(results, tracker, "B").trace,
                      makeFolder((folder / (std::string("figures-") + tracker)).string()));
#endif
  std::fprintf(stderr, "results and figures are in %s\n", folder.string().c_str());
}

int runExperiment(Arguments arguments) {
  arguments.options.images = !arguments.no_images;
  requireFigures(arguments);
  if (!arguments.out.empty()) makeFolder(arguments.out);  // known before the flights, not after
  const RigConfig rig = loadRig(resourceFolder() / "rigs" / "paper.toml");
  const FlightPlan plan = loadPlan(planPath("hover"));
  std::vector<MatsukawaResult> results;
  {
    Progress progress("Flying the experiments");
    results = flyMatsukawa2010(rig, plan, arguments.options,
                               [&](double done, const std::string& what) { progress.update(done, what); });
  }
  const std::string report = arguments.json ? reportJson(arguments, results) : reportText(arguments, results);
  if (std::fputs(report.c_str(), stdout) < 0 || std::fflush(stdout) != 0)
    throw Error(ErrorKind::kSystem, "the report cannot be written to standard output", {},
                "check the disk or the pipe");
  if (!arguments.out.empty()) writeResults(arguments, results);
  return 0;
}

}  // namespace

void addMatsukawa2010Experiment(CLI::App& experiments, int& exit_code) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = experiments.add_subcommand(
      "matsukawa2010", "The paper's experiments A and B, camera 1 alone, and our default, on the same seeds");
  command->add_option("--runs", arguments->options.runs, "Flights of each arm")
      ->check(CLI::Range(1, 100000))
      ->required();
  command->add_option("--seed", arguments->options.seed, "Seed of the first flight; the others follow it")
      ->capture_default_str();
  command->add_flag("--no-images", arguments->no_images, "Simulate observations instead of pixels");
  command->add_option("--out", arguments->out,
                      "Folder for figures 6 to 11 (PNG, PDF), every flight and the table");
  command->add_flag("--json", arguments->json, "Print one JSON object");
  command->callback([arguments, &exit_code] { exit_code = runExperiment(*arguments); });
}

}  // namespace helical
