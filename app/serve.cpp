#include "app/serve.h"

#include <signal.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <ctime>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/option_values.h"
#include "engine/base/error.h"
#include "engine/base/log.h"
#include "engine/base/monotonic.h"
#include "engine/config/resource_files.h"
#include "engine/config/rig_file.h"
#include "engine/pipeline/rig_hardware.h"
#include "engine/simulator/virtual_rig.h"

namespace helical {
namespace {

using nlohmann::json;

constexpr std::string_view kAravis = "aravis:";
constexpr std::size_t kMostServed = 250;

struct ServeArguments {
  std::string rig;
  std::uint64_t seed = 1;
  double duration_s = 0.0;
  double gust = -1.0;
  double vary = -1.0;
  bool json = false;
  std::vector<std::string> occlude, bump, loss, jitter, mute, taken, reboot, clock;
};

RigConfig servedRig(const ServeArguments& arguments) {
  RigConfig rig = loadRig(arguments.rig.empty() ? resourceFolder() / "rigs" / "virtual-gige.toml"
                                                : std::filesystem::path(arguments.rig));
  SimulationOptions& simulation = rig.simulation;
  simulation.seed = arguments.seed;
  if (arguments.gust >= 0.0) simulation.gust_factor = arguments.gust;
  if (arguments.vary >= 0.0) simulation.vary = arguments.vary;
  for (const auto& text : arguments.occlude) simulation.occlusions.push_back(parseOcclusion(text, rig));
  for (const auto& text : arguments.bump) simulation.bumps.push_back(parseBump(text, rig));
  validate(simulation);
  return rig;
}

/// The rig's own address of a camera, or for a simulated one the next from 127.0.0.2 on.
std::string addressOf(const CameraConfig& camera, std::size_t index) {
  if (camera.source.starts_with(kAravis)) return camera.source.substr(kAravis.size());
  return "127.0.0." + std::to_string(2 + index % kMostServed);
}

VirtualRigOptions virtualRig(const RigConfig& rig) {
  VirtualRigOptions options;
  for (std::size_t i = 0; i < rig.cameras.size(); ++i) {
    const CameraConfig& camera = rig.cameras[i];
    if (camera.model.width() % 2 != 0 || camera.model.height() % 2 != 0)
      throw Error(ErrorKind::kInput, "camera " + camera.label + " has an odd size", rig.path,
                  "only sensors with an even number of rows and columns are served");
    options.cameras.push_back(
        {addressOf(camera, i), camera.name, camera.model, trueCameraFromWorld(rig, cameraId(static_cast<int>(i)))});
  }
  options.markers = rig.markers_in_body;
  options.helicopter = rig.helicopter;
  options.simulation = rig.simulation;
  options.background_frames = rig.marker_options.background_frames;
  options.transmitter = rig.transmitter.address;
  return options;
}

std::vector<ScheduledFault> faults(const ServeArguments& arguments, const RigConfig& rig) {
  using Kind = ScheduledFault::Kind;
  std::vector<ScheduledFault> all;
  const auto add = [&](const std::vector<std::string>& texts, Kind kind, const char* option) {
    for (const auto& text : texts) all.push_back(parseFault(text, kind, option, rig));
  };
  add(arguments.loss, Kind::kLoss, "--loss");
  add(arguments.jitter, Kind::kJitter, "--jitter");
  add(arguments.mute, Kind::kMute, "--mute");
  add(arguments.taken, Kind::kTaken, "--taken");
  add(arguments.reboot, Kind::kReboot, "--reboot");
  add(arguments.clock, Kind::kClock, "--clock");
  return all;
}

std::string report(const VirtualRig& served, const RigConfig& rig, const VirtualRigOptions& options) {
  json result;
  result["cameras"] = json::array();
  for (std::size_t i = 0; i < served.cameraCount(); ++i) {
    const auto counts = served.camera(i).counts();
    result["cameras"].push_back({{"id", rig.cameras[i].label},
                                 {"address", options.cameras[i].address},
                                 {"frames", counts.frames},
                                 {"missed", counts.missed},
                                 {"resent_packets", counts.resent}});
  }
  const Verdict verdict = served.verdict();
  const double flight_s = served.flightTime();
  result["flight_s"] = flight_s >= 0.0 ? json(flight_s) : json(nullptr);
  result["flown"] = verdict.has_flown;
  result["at_rest"] = verdict.at_rest;
  result["crashed"] = verdict.crashed;
  result["crash_reason"] = verdict.crashed ? json(verdict.reason) : json(nullptr);
  result["touchdown_m_s"] = verdict.hardest_touch;
  return result.dump(2);
}

/// Until it is interrupted, or for `duration_s`.
void waitForEnd(const sigset_t& signals, double duration_s) {
  const TimeNs end = monotonicNow() + fromSeconds(duration_s);
  for (;;) {
    TimeNs left = kNanosecondsPerSecond;
    if (duration_s > 0.0) left = std::min(left, end - monotonicNow());
    if (left <= 0) return;
    const timespec timeout{left / kNanosecondsPerSecond, left % kNanosecondsPerSecond};
    if (sigtimedwait(&signals, nullptr, &timeout) > 0) return;
  }
}

void serve(const ServeArguments& arguments) {
  const RigConfig rig = servedRig(arguments);
  const VirtualRigOptions options = virtualRig(rig);
  const std::vector<ScheduledFault> scheduled = faults(arguments, rig);
  // Blocked before the threads start, so that this one gets them.
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGINT);
  sigaddset(&signals, SIGTERM);
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  VirtualRig served(options, scheduled);
  for (std::size_t i = 0; i < options.cameras.size(); ++i)
    log(LogLevel::kInfo, rig.cameras[i].name + " is a GigE Vision camera on " + options.cameras[i].address);
  log(LogLevel::kInfo, "sticks are taken on " + options.transmitter + "; Ctrl-C ends it");
  waitForEnd(signals, arguments.duration_s);
  if (!arguments.json) return;
  const std::string text = report(served, rig, options) + "\n";
  if (std::fputs(text.c_str(), stdout) < 0 || std::fflush(stdout) != 0)
    throw Error(ErrorKind::kSystem, "the report cannot be written to standard output", {},
                "check the disk or the pipe");
}

}  // namespace

void addServeCommand(CLI::App& app, int& exit_code) {
  auto arguments = std::make_shared<ServeArguments>();
  CLI::App* command =
      app.add_subcommand("serve", "The simulated rig as GigE Vision cameras on this machine's loopback");
  command->add_option("--rig", arguments->rig, "Rig file (default: virtual-gige.toml)");
  command->add_option("--seed", arguments->seed, "Seed of everything that is drawn at random")->capture_default_str();
  command->add_option("--duration", arguments->duration_s, "Ends after so many seconds")->check(CLI::PositiveNumber);
  command->add_option("--gust", arguments->gust, "Scales the gusts; 0 is still air")->check(CLI::NonNegativeNumber);
  command->add_option("--vary", arguments->vary, "Draws every helicopter parameter within +-FRACTION")
      ->check(CLI::Range(0.0, 0.9));
  command->add_option("--occlude", arguments->occlude, "CAM@FROM-TO: a white board before a camera [s]");
  command->add_option("--bump", arguments->bump, "CAM@T:DEG,M: knock a camera at T [s] by degrees and metres");
  command->add_option("--loss", arguments->loss, "CAM@FROM-TO:SHARE: packets are lost [s, 0 to 1]");
  command->add_option("--jitter", arguments->jitter, "CAM@FROM-TO:S: frames come up to so much later [s]");
  command->add_option("--mute", arguments->mute, "CAM@FROM-TO: the cable is out [s]");
  command->add_option("--taken", arguments->taken, "CAM@FROM-TO: another host takes control [s]");
  command->add_option("--reboot", arguments->reboot, "CAM@FROM-TO: the power is off; all settings are forgotten [s]");
  command->add_option("--clock", arguments->clock,
                      "CAM@FROM-TO:S,PPM: its clock jumps by S, then runs fast by PPM [s]");
  command->add_flag("--json", arguments->json, "Print one JSON object at the end");
  command->footer("Times count from when a transmitter is switched on, before that from the start.");
  command->callback([arguments, &exit_code] {
    serve(*arguments);
    exit_code = 0;
  });
}

}  // namespace helical
