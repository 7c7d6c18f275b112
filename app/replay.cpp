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
#include "engine/session/replay.h"

namespace helical {
namespace {

struct Arguments {
  std::string session;
  std::string calibrator;
  std::vector<std::string> occlude;
  bool json = false;
};

std::string knownCalibrators() {
  std::string names;
  for (const auto name : calibratorNames()) names += (names.empty() ? "" : ", ") + std::string(name);
  return names;
}

/// Cameras that had no pose in the flight get a first guess, too. True if that is another flight loop than
/// the recorded one.
bool changeCalibrator(const std::string& name, RigConfig& rig) {
  if (name.empty()) return false;
  const auto names = calibratorNames();
  if (std::find(names.begin(), names.end(), name) == names.end())
    throw Error(ErrorKind::kInput, "there is no calibrator " + name, "--calibrator",
                "give one of " + knownCalibrators());
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

int replayFlight(const Arguments& arguments) {
  McapReader session(arguments.session);
  SessionSettings settings = fromAttachments(session.attachments(), arguments.session);
  bool changed = changeCalibrator(arguments.calibrator, settings.rig);
  ReplayChanges changes;
  for (const auto& text : arguments.occlude) changes.occlusions.push_back(parseOcclusion(text, settings.rig));
  changed = changed || !changes.occlusions.empty();

  const MonotonicClock stopwatch;
  const Replay replay = replaySession(session, settings, changes, [](const EngineSnapshot&) {});
  warnOfGaps(session, replay);
  FlightRun run;
  run.score = replay.score;
  run.last = replay.last;
  run.wall_s = toSeconds(stopwatch.now());
  run.session = arguments.session;
  const std::string report =
      arguments.json ? jsonReport(run, settings.rig, replay, changed) : textReport(run, settings.rig, replay);
  if (std::fputs(report.c_str(), stdout) < 0 || std::fflush(stdout) != 0)
    throw Error(ErrorKind::kSystem, "the report cannot be written to standard output", {},
                "check the disk or the pipe");
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
  command->add_flag("--json", arguments->json, "Print one JSON object");
  command->callback([arguments, &exit_code] { exit_code = replayFlight(*arguments); });
}

}  // namespace helical
