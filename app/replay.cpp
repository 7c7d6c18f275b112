#include "app/replay.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/flight_report.h"
#include "app/option_values.h"
#include "engine/base/clock.h"
#include "engine/base/error.h"
#include "engine/base/log.h"
#include "engine/calibration/calibrator_factory.h"
#include "engine/experiments/flight_run.h"
#include "engine/geometry/rotation.h"
#include "engine/pipeline/first_guess.h"
#include "engine/session/fork.h"
#include "engine/session/replay.h"

namespace helical {
namespace {

struct Arguments {
  std::string session;
  std::string calibrator;
  std::vector<std::string> occlude;
  double fork_at_s = -1.0;  ///< negative: no fork
  bool json = false;
};

std::string knownCalibrators() {
  std::string names;
  for (const auto name : calibratorNames()) names += (names.empty() ? "" : ", ") + std::string(name);
  return names;
}

void requireCalibrator(const std::string& name) {
  const auto names = calibratorNames();
  if (std::find(names.begin(), names.end(), name) == names.end())
    throw Error(ErrorKind::kInput, "there is no calibrator " + name, "--calibrator",
                "give one of " + knownCalibrators());
}

/// Cameras that had no pose in the flight get a first guess, too. True if that is another flight loop than
/// the recorded one.
bool changeCalibrator(const std::string& name, RigConfig& rig) {
  if (name.empty()) return false;
  requireCalibrator(name);
  const bool poseless = std::any_of(rig.cameras.begin(), rig.cameras.end(),
                                    [](const CameraConfig& camera) { return !camera.camera_from_world; });
  const bool changed = poseless || name != rig.calibrator;
  rig.calibrator = name;
  giveFirstGuesses(rig, toRadians(kFirstGuessErrorDeg), kFirstGuessErrorM, rig.simulation.seed, false);
  return changed;
}

std::string jsonReport(const FlightRun& run, const RigConfig& rig, const Replay& replay, bool changed) {
  nlohmann::json report = nlohmann::json::parse(flightJson(run, rig));
  const bool differs = replay.first_difference_s >= 0.0;
  report["replay"] = {
      {"changed", changed},
      {"bit_for_bit", !differs},
      {"ticks", replay.ticks},
      {"different_ticks", replay.different_ticks},
      {"first_difference_s", differs ? nlohmann::json(replay.first_difference_s) : nlohmann::json(nullptr)},
      {"position_difference_rms_m", replay.position_difference.count() > 0
                                        ? nlohmann::json(replay.position_difference.value())
                                        : nlohmann::json(nullptr)},
      {"missing", replay.missing}};
  return report.dump(2) + "\n";
}

std::string textReport(const FlightRun& run, const RigConfig& rig, const Replay& replay) {
  std::string text = flightText(run, rig);
  if (replay.first_difference_s < 0.0)
    return text + "  replay    the same as recorded, bit for bit, in all " + std::to_string(replay.ticks) +
           " ticks\n";
  char line[160];
  std::snprintf(
      line, sizeof line,
      "  replay    differs from the record in %llu of %llu ticks, first at %.3f s; poses by %.2f mm RMS\n",
      static_cast<unsigned long long>(replay.different_ticks), static_cast<unsigned long long>(replay.ticks),
      replay.first_difference_s, 1e3 * replay.position_difference.value());
  return text + line;
}

void warnOfGaps(const McapReader& session, const Replay& replay) {
  if (!session.complete())
    log(LogLevel::kWarning, session.file().string() + " was cut off: replayed as far as it goes");
  if (replay.missing > 0)
    log(LogLevel::kWarning, session.file().string() + " lacks " + std::to_string(replay.missing) +
                                " observations or ticks: the replay cannot come out the same");
}

void print(const std::string& report) {
  if (std::fputs(report.c_str(), stdout) < 0 || std::fflush(stdout) != 0)
    throw Error(ErrorKind::kSystem, "the report cannot be written to standard output", {},
                "check the disk or the pipe");
}

std::string forkReport(const Arguments& arguments, const FlightRun& run, const RigConfig& rig,
                       const Fork& fork) {
  const bool crashed = run.last.verdict.crashed;
  if (arguments.json) {
    nlohmann::json report = nlohmann::json::parse(flightJson(run, rig));
    report["fork"] = {{"at_s", arguments.fork_at_s},
                      {"ticks_before", fork.ticks_before},
                      {"different_before", fork.different_before},
                      {"would_have_crashed", crashed},
                      {"recorded_crashed", fork.recorded_crashed}};
    return report.dump(2) + "\n";
  }
  char line[200];
  std::snprintf(line, sizeof line, "  fork      at %.3f s: it %s crashed; the recorded flight %s\n",
                arguments.fork_at_s, crashed ? "would have" : "would not have",
                fork.recorded_crashed ? "did" : "did not");
  return flightText(run, rig) + line;
}

/// Exit code 1 when it would have crashed, as of a flight.
int forkFlight(const Arguments& arguments, McapReader& session, const SessionSettings& settings) {
  if (!arguments.calibrator.empty()) requireCalibrator(arguments.calibrator);
  ForkChanges changes;
  changes.at_s = arguments.fork_at_s;
  changes.calibrator = arguments.calibrator;
  for (const auto& text : arguments.occlude) changes.occlusions.push_back(parseOcclusion(text, settings.rig));
  const double planned_s = std::max(plannedSeconds(settings.plan), toSeconds(session.lastTime()));
  FlightEnd end(planned_s + kTimeToSpareS);
  FlightRun run;
  const MonotonicClock stopwatch;
  const Fork fork = forkSession(
      session, settings, changes, [](const EngineSnapshot&) {},
      [&](const EngineSnapshot& now) { return end.isOver(now); });
  if (fork.different_before > 0)
    log(LogLevel::kWarning, "up to the fork " + std::to_string(fork.different_before) +
                                " ticks came out otherwise than recorded: another version made the session");
  run.score = fork.score;
  run.last = fork.last;
  run.wall_s = toSeconds(stopwatch.now());
  run.session = arguments.session;
  print(forkReport(arguments, run, settings.rig, fork));
  return fork.different_before == 0 && !run.last.verdict.crashed ? 0 : 1;
}

int replayFlight(const Arguments& arguments) {
  McapReader session(arguments.session);
  SessionSettings settings = fromAttachments(session.attachments(), arguments.session);
  if (arguments.fork_at_s >= 0.0) return forkFlight(arguments, session, settings);
  bool changed = changeCalibrator(arguments.calibrator, settings.rig);
  ReplayChanges changes;
  changes.other_calibrator = !arguments.calibrator.empty();
  for (const auto& text : arguments.occlude) changes.occlusions.push_back(parseOcclusion(text, settings.rig));
  changed = changed || !changes.occlusions.empty();

  const MonotonicClock stopwatch;
  const Replay replay = replaySession(session, settings, changes, [](const EngineSnapshot&) {});
  changed = changed || replay.other_methods;
  warnOfGaps(session, replay);
  FlightRun run;
  run.score = replay.score;
  run.last = replay.last;
  run.wall_s = toSeconds(stopwatch.now());
  run.session = arguments.session;
  print(arguments.json ? jsonReport(run, settings.rig, replay, changed)
                       : textReport(run, settings.rig, replay));
  return changed || replay.first_difference_s < 0.0 ? 0 : 1;
}

}  // namespace

void addReplayCommand(CLI::App& app, int& exit_code) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command =
      app.add_subcommand("replay", "A recorded flight through the pipeline again: what would it have known?");
  command->add_option("SESSION", arguments->session, "The session's MCAP file")->required();
  command->add_option("--calibrator", arguments->calibrator, "Another one: " + knownCalibrators());
  command->add_option("--occlude", arguments->occlude, "CAM@FROM-TO: a white board before a camera [s]");
  command
      ->add_option(
          "--fork-at", arguments->fork_at_s,
          "Fly on from this time [s] with the other settings: would it have crashed? Simulated flights")
      ->check(CLI::NonNegativeNumber);
  command->add_flag("--json", arguments->json, "Print one JSON object");
  command->callback([arguments, &exit_code] { exit_code = replayFlight(*arguments); });
}

}  // namespace helical
