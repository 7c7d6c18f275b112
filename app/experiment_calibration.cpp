#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "app/calibration_report.h"
#include "app/experiment.h"
#include "app/progress.h"
#include "engine/base/error.h"
#include "engine/calibration/calibrator_factory.h"
#include "engine/config/resource_files.h"
#include "engine/config/rig_file.h"

namespace helical {
namespace {

constexpr int kMostKnocks = 200;       // flights of 15 s
constexpr int kQuietMinutes = 60;      // of three cameras: three camera-hours
constexpr int kSixteenRounds = 4;
constexpr double kMemoryFlightS = 3600.0;
constexpr const char* kSixteen = "sixteen-cameras";
constexpr const char* kMemory = "memory";

struct Arguments {
  int runs = 200;
  std::uint64_t seed = 1;
  std::vector<std::string> only;
  std::vector<std::string> calibrators;  ///< of conditions that several are compared in; empty: all
  bool json = false;
};

std::vector<QuietCondition> quietConditions() {
  return {{"no-knock-outliers-1", 0.01, kQuietMinutes}, {"no-knock-outliers-10", 0.1, kQuietMinutes}};
}

std::vector<std::string> conditionNames() {
  std::vector<std::string> names;
  for (const auto& condition : calibrationConditions())
    if (std::find(names.begin(), names.end(), condition.name) == names.end()) names.push_back(condition.name);
  for (const auto& condition : knockConditions()) names.push_back(condition.name);
  for (const auto& condition : quietConditions()) names.push_back(condition.name);
  names.insert(names.end(), {kSixteen, kMemory});
  return names;
}

/// What was asked for, one after the other, and how far it is.
class Study {
 public:
  explicit Study(const Arguments& arguments) : arguments_(arguments) {
    report_.runs = arguments.runs;
    report_.seed = arguments.seed;
  }

  CalibrationReport run() {
    countParts();
    for (const auto& condition : calibrationConditions())
      if (wanted(condition))
        report_.conditions.push_back(studyCalibration(
            condition, arguments_.runs, arguments_.seed,
            part(condition.name + ", " + condition.calibrator, arguments_.runs)));
    const RigConfig calibrated = loadRig(resourceFolder() / "rigs" / "calibrated.toml");
    const int knocks = std::min(arguments_.runs, kMostKnocks);
    for (const auto& condition : knockConditions())
      if (wanted(condition.name))
        report_.knocks.push_back(
            studyKnocks(calibrated, condition, knocks, arguments_.seed, part(condition.name, knocks)));
    for (const auto& condition : quietConditions())
      if (wanted(condition.name))
        report_.quiet.emplace_back(condition,
                                   studyFalseAlarms(calibrated, condition.outliers, condition.minutes,
                                                    arguments_.seed, part(condition.name, condition.minutes)));
    if (wanted(kSixteen))
      report_.sixteen =
          studySixteenCameras(kSixteenRounds, arguments_.seed, part(kSixteen, kSixteenRounds));
    if (wanted(kMemory)) {
      const auto progress = part(kMemory, 1000);
      report_.memory = studyMemory(loadRig(resourceFolder() / "rigs" / "paper.toml"), kMemoryFlightS, arguments_.seed,
                                   [&](double done) { progress(static_cast<int>(1000.0 * done)); });
    }
    return std::move(report_);
  }

 private:
  bool wanted(const std::string& name) const {
    return arguments_.only.empty() ||
           std::find(arguments_.only.begin(), arguments_.only.end(), name) != arguments_.only.end();
  }

  bool wanted(const CalibrationCondition& condition) const {
    const auto& names = arguments_.calibrators;
    return wanted(condition.name) &&
           (names.empty() || std::find(names.begin(), names.end(), condition.calibrator) != names.end());
  }

  void countParts() {
    for (const auto& condition : calibrationConditions()) parts_ += wanted(condition);
    for (const auto& condition : knockConditions()) parts_ += wanted(condition.name);
    for (const auto& condition : quietConditions()) parts_ += wanted(condition.name);
    parts_ += wanted(kSixteen) + wanted(kMemory);
  }

  std::function<void(int)> part(const std::string& note, int runs) {
    const int begun = begun_++;
    return [this, note, runs, begun](int done) {
      progress_.update((begun + static_cast<double>(done) / runs) / parts_, note);
    };
  }

  const Arguments& arguments_;
  CalibrationReport report_;
  Progress progress_{"Calibrating"};
  int parts_ = 0, begun_ = 0;
};

int runExperiment(const Arguments& arguments) {
  const CalibrationReport report = Study(arguments).run();
  const std::string text = arguments.json ? calibrationReportJson(report) : calibrationReportText(report);
  if (std::fputs(text.c_str(), stdout) < 0 || std::fflush(stdout) != 0)
    throw Error(ErrorKind::kSystem, "the report cannot be written to standard output", {},
                "check the disk or the pipe");
  return 0;
}

}  // namespace

void addCalibrationExperiment(CLI::App& experiments, int& exit_code) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = experiments.add_subcommand(
      "calibration",
      "Cameras calibrated in flight: error over its Cramer-Rao bound, every method; knocks, false alarms, cost, memory");
  command->add_option("--runs", arguments->runs, "Flights for each condition (of knocks at most 200)")
      ->check(CLI::Range(2, 1000000))
      ->capture_default_str();
  command->add_option("--seed", arguments->seed, "First seed of everything that is drawn at random")
      ->capture_default_str();
  command->add_option("--only", arguments->only, "These conditions only, by name")
      ->check(CLI::IsMember(conditionNames()))
      ->delimiter(',');
  command->add_option("--calibrator", arguments->calibrators, "These methods only, where several are compared")
      ->check(CLI::IsMember(std::vector<std::string>(calibratorNames().begin(), calibratorNames().end())))
      ->delimiter(',');
  command->add_flag("--json", arguments->json, "Print one JSON object");
  command->callback([arguments, &exit_code] { exit_code = runExperiment(*arguments); });
}

}  // namespace helical
