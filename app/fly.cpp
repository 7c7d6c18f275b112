#include "app/fly.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "app/flight_report.h"
#include "app/option_values.h"
#include "app/progress.h"
#include "engine/base/error.h"
#include "engine/base/log.h"
#include "engine/calibration/calibrator_factory.h"
#include "engine/calibration/self_calibration_limits.h"
#include "engine/config/calibration_file.h"
#include "engine/config/plan_file.h"
#include "engine/config/resource_files.h"
#include "engine/config/rig_file.h"
#include "engine/config/text_file.h"
#include "engine/experiments/flight_run.h"
#include "engine/geometry/rotation.h"
#include "engine/pipeline/calibration_record.h"
#include "engine/pipeline/first_guess.h"
#include "engine/pipeline/rig_devices.h"
#include "engine/session/recorder.h"

namespace helical {
namespace {

constexpr int kProgressTicks = 60;
constexpr double kLongestRecordingS = 24.0 * 3600.0;

struct FlyArguments {
  std::string rig;
  std::string plan = "hover";
  std::uint64_t seed = 1;
  double duration_s = 0.0;
  bool no_images = false;
  bool realtime = false;
  bool json = false;
  std::string session;
  std::vector<std::string> session_images;
  std::string calibration, save_calibration;  ///< files
  std::vector<std::string> occlude;
  std::vector<std::string> bump;
  std::vector<double> refine_at_s;
  double refine_markers_m = -1.0, refine_focal = -1.0;
  std::vector<std::string> uncalibrated;
  std::string tracker;
  std::string calibrator;
  std::vector<double> initial_error;  ///< degrees, metres
  double pixel_noise = -1.0;
  double outliers = -1.0;
  double gust = -1.0;
  double vary = -1.0;
  double marker_error_m = -1.0, focal_error = -1.0;
  double rate = -1.0;
};

/// Cameras without a pose find it by `joint`, which needs no first guess; those who name a method or how far a
/// guess is off get one.
void calibrateInFlight(const FlyArguments& arguments, RigConfig& rig) {
  if (!arguments.calibrator.empty()) rig.calibrator = arguments.calibrator;
  const bool given = arguments.initial_error.size() == 2;
  if (arguments.calibrator.empty() && !given) return;
  giveFirstGuesses(rig, toRadians(given ? arguments.initial_error[0] : kFirstGuessErrorDeg),
                   given ? arguments.initial_error[1] : kFirstGuessErrorM, arguments.seed, given);
}

/// Its field is this process's own, though it lives in real time: its output alone goes through another one.
bool hasFieldOfItsOwn(const RigConfig& rig) {
  return rig.transmitter.kind == "output-process" &&
         std::all_of(rig.cameras.begin(), rig.cameras.end(), [](const auto& camera) { return camera.source == "sim"; });
}

/// What changes the simulated field would do nothing to a real one.
void refuseSimulationOptions(const FlyArguments& a, const RigConfig& rig) {
  if (!a.realtime)
    throw Error(ErrorKind::kInput, "this rig's cameras or transmitter live in real time", rig.path,
                "fly it with --realtime");
  const bool simulated = !a.occlude.empty() || !a.bump.empty() || a.pixel_noise >= 0.0 || a.outliers >= 0.0 ||
                         a.gust >= 0.0 || a.vary >= 0.0 || a.marker_error_m >= 0.0 || a.focal_error >= 0.0 ||
                         a.no_images;
  if (simulated && !hasFieldOfItsOwn(rig))
    throw Error(ErrorKind::kInput, "an option changes the simulated field, and this rig's is real", rig.path,
                "leave out --occlude, --bump, --pixel-noise, --outliers, --gust, --vary, --marker-error, "
                "--focal-error and --no-images; `helical serve` takes some of them");
}

RigConfig configuredRig(const FlyArguments& arguments) {
  RigConfig rig = loadRig(arguments.rig.empty() ? resourceFolder() / "rigs" / "paper.toml"
                                                : std::filesystem::path(arguments.rig));
  if (needsRealTime(rig)) refuseSimulationOptions(arguments, rig);
  SimulationOptions& simulation = rig.simulation;
  simulation.seed = arguments.seed;
  simulation.images = !arguments.no_images;
  if (arguments.pixel_noise >= 0.0) simulation.noise.sigma_px = arguments.pixel_noise;
  if (arguments.outliers >= 0.0) simulation.noise.outliers = arguments.outliers;
  if (arguments.gust >= 0.0) simulation.gust_factor = arguments.gust;
  if (arguments.vary >= 0.0) simulation.vary = arguments.vary;
  if (arguments.marker_error_m >= 0.0) simulation.marker_error_m = arguments.marker_error_m;
  if (arguments.focal_error >= 0.0) simulation.focal_error = arguments.focal_error;
  if (arguments.refine_markers_m >= 0.0) rig.self_calibration.marker_sigma_m = arguments.refine_markers_m;
  if (arguments.refine_focal >= 0.0) rig.self_calibration.focal_sigma = arguments.refine_focal;
  if (arguments.rate > 0.0) {
    simulation.camera_rate_hz = arguments.rate;
    for (CameraConfig& camera : rig.cameras) camera.device.rate_hz = arguments.rate;
  }
  if (!arguments.tracker.empty()) rig.tracker = arguments.tracker;
  for (const auto& text : arguments.occlude) simulation.occlusions.push_back(parseOcclusion(text, rig));
  for (const auto& text : arguments.bump) simulation.bumps.push_back(parseBump(text, rig));
  simulation.true_camera_from_world.resize(rig.cameras.size());
  for (const auto& label : arguments.uncalibrated) {
    const auto index = static_cast<std::size_t>(rig.camera(label).index());
    auto& truth = simulation.true_camera_from_world[index];
    if (!truth) truth = rig.cameras[index].camera_from_world;
    rig.cameras[index].camera_from_world.reset();
  }
  if (!arguments.calibration.empty()) giveCalibration(loadCalibration(arguments.calibration), rig);
  calibrateInFlight(arguments, rig);
  validate(simulation);
  return rig;
}

FlightPlan configuredPlan(const FlyArguments& arguments) {
  FlightPlan plan = loadPlan(planPath(arguments.plan));
  if (arguments.duration_s > 0.0) landWithin(plan, arguments.duration_s);
  return plan;
}

std::string knownCalibrators() {
  std::string names;
  for (const auto name : calibratorNames()) names += (names.empty() ? "" : ", ") + std::string(name);
  return names;
}

/// Null when nobody asked for a record.
std::unique_ptr<Recorder> startRecorder(const FlyArguments& arguments, const RigConfig& rig,
                                        const FlightPlan& plan) {
  if (arguments.session.empty()) return nullptr;
  SessionSettings settings;
  settings.rig_text = readTextFile(rig.path, "rig file");
  settings.plan_text = readTextFile(planPath(arguments.plan), "flight plan");
  settings.rig = rig;
  settings.plan = plan;
  settings.realtime = arguments.realtime;
  settings.images = parseImageRecordings(arguments.session_images, rig);
  return std::make_unique<Recorder>(
      arguments.session, settings,
      arguments.realtime ? Recorder::WhenFull::kDrop : Recorder::WhenFull::kWait);
}

/// The flight counts, whatever became of its record.
void finishRecord(Recorder& recorder) {
  recorder.finish();
  if (recorder.lost() > 0)
    log(LogLevel::kWarning, "the disk was too slow: the record lacks " + std::to_string(recorder.lost()) +
                                " observations, ticks or events");
  if (recorder.lostImages() > 0)
    log(LogLevel::kWarning,
        "the disk was too slow: the record lacks " + std::to_string(recorder.lostImages()) + " images");
}

bool recordingsFailed(const EngineSnapshot& last) {
  return std::any_of(last.cameras.begin(), last.cameras.end(),
                     [](const CameraSnapshot& camera) { return camera.link == LinkState::kStalled; });
}

std::vector<TimedOrder> refinements(const FlyArguments& arguments) {
  std::vector<TimedOrder> orders;
  for (const double at_s : arguments.refine_at_s) {
    orders.emplace_back().at_s = at_s;
    orders.back().order.kind = CalibrationOrderKind::kRefine;
  }
  std::sort(orders.begin(), orders.end(),
            [](const TimedOrder& a, const TimedOrder& b) { return a.at_s < b.at_s; });
  return orders;
}

int fly(const FlyArguments& arguments) {
  const RigConfig rig = configuredRig(arguments);
  const FlightPlan plan = configuredPlan(arguments);
  const bool looks_on = isOfRecordings(rig);
  const double planned_s = looks_on && arguments.duration_s <= 0.0 ? kLongestRecordingS : plannedSeconds(plan);
  const std::unique_ptr<Recorder> recorder = startRecorder(arguments, rig, plan);
  FlightRun run;
  {
    Progress progress("Flying " + plan.name);
    const auto show = [&](const EngineSnapshot& now) {
      if (now.tick % kProgressTicks == 0)
        progress.update(toSeconds(now.time) / planned_s, toString(now.phase));
    };
    const std::vector<TimedOrder> orders = refinements(arguments);
    run = runFlight(rig, plan, planned_s + kTimeToSpareS, arguments.realtime, show, recorder.get(), orders);
  }
  if (recorder) finishRecord(*recorder);
  if (!arguments.save_calibration.empty())
    saveCalibration(arguments.save_calibration, calibrationOf(rig, run.last));
  run.session = arguments.session;
  const std::string report = arguments.json ? flightJson(run, rig) + "\n" : flightText(run, rig);
  if (std::fputs(report.c_str(), stdout) < 0 || std::fflush(stdout) != 0)
    throw Error(ErrorKind::kSystem, "the report cannot be written to standard output", {},
                "check the disk or the pipe");
  if (looks_on) return recordingsFailed(run.last) ? 2 : 0;
  return outcomeOf(run.last, run.score) == "landed" ? 0 : 1;
}

}  // namespace

void addFlyCommand(CLI::App& app, int& exit_code) {
  auto arguments = std::make_shared<FlyArguments>();
  CLI::App* command = app.add_subcommand("fly", "Fly once, headless");
  command->add_option("--rig", arguments->rig, "Rig file (default: the paper's rig)");
  command->add_option("--plan", arguments->plan, "Flight plan: hover, waypoints, or a file")
      ->capture_default_str();
  command->add_option("--seed", arguments->seed, "Seed of everything that is drawn at random")
      ->capture_default_str();
  command->add_option("--duration", arguments->duration_s, "Length of the session in seconds")
      ->check(CLI::PositiveNumber);
  command->add_flag("--no-images", arguments->no_images, "Simulate observations instead of pixels");
  command->add_option("--occlude", arguments->occlude, "CAM@FROM-TO: a white board before a camera [s]");
  command->add_option("--bump", arguments->bump,
                      "CAM@T:DEG,M: knock a camera at T [s] by degrees and metres");
  command->add_option("--pixel-noise", arguments->pixel_noise, "Centroid noise without images [px]")
      ->check(CLI::NonNegativeNumber);
  command->add_option("--outliers", arguments->outliers, "Share of centroids thrown aside")
      ->check(CLI::Range(0.0, 1.0));
  command->add_option("--gust", arguments->gust, "Scales the gusts; 0 is still air")
      ->check(CLI::NonNegativeNumber);
  command->add_option("--vary", arguments->vary, "Draws every helicopter parameter within +-FRACTION")
      ->check(CLI::Range(0.0, 0.9));
  command
      ->add_option("--marker-error", arguments->marker_error_m,
                   "METRES: balls are not where the rig says, by so much per axis, drawn")
      ->check(CLI::Range(0.0, kMostMarkerSigmaM));
  command
      ->add_option("--focal-error", arguments->focal_error,
                   "SHARE: focal lengths are not what the rig says, by so much, drawn per camera")
      ->check(CLI::Range(0.0, kMostFocalSigma));
  command->add_option("--uncalibrated", arguments->uncalibrated, "CAM,...: cameras whose pose is not known")
      ->delimiter(',');
  command->add_option("--tracker", arguments->tracker,
                      "helical (default), or paper: latest images, plain least squares");
  command->add_option("--calibrator", arguments->calibrator,
                      "Calibrates cameras without a pose in flight: " + knownCalibrators() +
                          " (default joint, without a first guess)");
  command
      ->add_option("--initial-error", arguments->initial_error,
                   "DEG,M: how far off their first guess is (default 15,0.4)")
      ->delimiter(',')
      ->expected(2)
      ->check(CLI::NonNegativeNumber);
  CLI::Option* refine =
      command
          ->add_option("--refine", arguments->refine_at_s,
                       "T: solve for all cameras together from what they saw up to T [s]")
          ->check(CLI::NonNegativeNumber);
  command
      ->add_option("--refine-markers", arguments->refine_markers_m,
                   "METRES: refinements also find balls that are off the rig's places, by about so much per axis")
      ->check(CLI::Range(0.0, kMostMarkerSigmaM))
      ->needs(refine);
  command
      ->add_option("--refine-focal", arguments->refine_focal,
                   "SHARE: refinements also find focal lengths that are off the rig's, by about so much")
      ->check(CLI::Range(0.0, kMostFocalSigma))
      ->needs(refine);
  command->add_option("--calibration", arguments->calibration,
                      "Cameras stand where this file says, which --save-calibration wrote");
  command->add_option("--save-calibration", arguments->save_calibration,
                      "Write where the cameras of the control set stand at the end to this file");
  command->add_option("--rate", arguments->rate, "Frame rate of the cameras [Hz]")
      ->check(CLI::PositiveNumber);
  command->add_flag("--realtime", arguments->realtime,
                    "At the pace of the wall clock, in the engine's own threads");
  CLI::Option* session =
      command->add_option("--session", arguments->session, "Record the flight to this MCAP file");
  command
      ->add_option("--session-images", arguments->session_images,
                   "[CAM=]off|jpeg|lossless[@HZ]: images in the record, of one camera or all (default off)")
      ->needs(session);
  command->add_flag("--json", arguments->json, "Print one JSON object");
  command->callback([arguments, &exit_code] { exit_code = fly(*arguments); });
}

}  // namespace helical
