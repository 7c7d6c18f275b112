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
#include "engine/config/plan_file.h"
#include "engine/config/resource_files.h"
#include "engine/config/rig_file.h"
#include "engine/experiments/fault_study.h"

namespace helical {
namespace {

using nlohmann::json;

constexpr double kLandAtS = 13.0;
constexpr int kFailed = 1;

struct Arguments {
  int runs = 50;
  std::uint64_t seed = 1;
  bool json = false;
};

json number(double value) {
  return std::isfinite(value) ? json(value) : json(nullptr);
}

json rowJson(const FaultRow& row) {
  return {{"name", toString(row.kind)},
          {"runs", row.runs},
          {"counted", row.counted},
          {"missed", row.missed},
          {"detected_s", {{"median", number(row.median_s)}, {"max", number(row.longest_s)}}},
          {"limit_s", number(detectionLimit(row.kind))},
          {"worst_seed", row.counted > 0 ? json(row.worst_seed) : json(nullptr)}};
}

std::string reportJson(const Arguments& arguments, const FaultStudy& study) {
  json report{{"runs", arguments.runs},
              {"seed", arguments.seed},
              {"breaches", study.breaches.size()},
              {"hard_landings", study.hard_landings.size()},
              {"bad_armings", study.bad_armings.size()},
              {"hard_as_the_oracle", study.excused.size()},
              {"seeds",
               {{"breaches", study.breaches},
                {"hard_landings", study.hard_landings},
                {"bad_armings", study.bad_armings}}},
              {"faults", json::array()}};
  for (const FaultRow& row : study.rows()) report["faults"].push_back(rowJson(row));
  return report.dump(2) + "\n";
}

std::string list(const char* what, const std::vector<std::uint64_t>& seeds) {
  std::string text = std::string(what) + ": " + std::to_string(seeds.size());
  for (std::size_t i = 0; i < seeds.size() && i < 20; ++i) text += (i == 0 ? "; seeds " : ", ") + std::to_string(seeds[i]);
  return text + (seeds.size() > 20 ? ", ...\n" : "\n");
}

std::string seconds(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%9.3f", value);
  return std::isfinite(value) ? text : "        -";
}

std::string reportText(const Arguments& arguments, const FaultStudy& study) {
  std::string text = std::to_string(arguments.runs) + " flights with one to four random faults each\n\n" +
                     list("powered more than 0.3 m outside the hard fence", study.breaches) +
                     list("hit the ground above 1 m/s where the oracle did not", study.hard_landings) +
                     list("armed where it must not", study.bad_armings) +
                     list("hit the ground above 1 m/s, as the oracle did", study.excused) +
                     "\nfault                   flights counted missed   median   longest    limit  worst seed\n";
  for (const FaultRow& row : study.rows()) {
    char line[160];
    std::snprintf(line, sizeof line, "%-24s%7d %7d %6d%s%s%s  %s\n", toString(row.kind), row.runs, row.counted, row.missed,
                  seconds(row.median_s).c_str(), (" " + seconds(row.longest_s)).c_str(),
                  seconds(detectionLimit(row.kind)).c_str(),
                  row.counted > 0 ? std::to_string(row.worst_seed).c_str() : "-");
    text += line;
  }
  return text + "\nDetection in seconds. Counted: it lasted longer than its limit, with something there to notice.\n";
}

int runExperiment(const Arguments& arguments) {
  const RigConfig rig = loadRig(resourceFolder() / "rigs" / "calibrated.toml");
  FlightPlan plan = loadPlan(planPath("hover"));
  plan.land_at_s = kLandAtS;
  FaultStudy study;
  {
    Progress progress("Flying with faults");
    study = studyFaults(rig, plan, arguments.runs, arguments.seed,
                        [&](int done) { progress.update(static_cast<double>(done) / arguments.runs); });
  }
  const std::string report = arguments.json ? reportJson(arguments, study) : reportText(arguments, study);
  if (std::fputs(report.c_str(), stdout) < 0 || std::fflush(stdout) != 0)
    throw Error(ErrorKind::kSystem, "the report cannot be written to standard output", {}, "check the disk or the pipe");
  return study.breaches.empty() && study.hard_landings.empty() && study.bad_armings.empty() ? 0 : kFailed;
}

}  // namespace

void addFaultsExperiment(CLI::App& experiments, int& exit_code) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = experiments.add_subcommand(
      "faults", "Flights in which cameras, transmitter, processor and disk fail, alone and together");
  command->add_option("--runs", arguments->runs, "Flights")->check(CLI::Range(1, 1000000))->capture_default_str();
  command->add_option("--seed", arguments->seed, "First seed of everything that is drawn at random")->capture_default_str();
  command->add_flag("--json", arguments->json, "Print one JSON object");
  command->footer("Exit code 1: a flight was powered outside its fence, hit the ground hard or armed where it must not.");
  command->callback([arguments, &exit_code] { exit_code = runExperiment(*arguments); });
}

}  // namespace helical
