#include "engine/experiments/matsukawa2010.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "engine/experiments/flight_run.h"
#include "engine/experiments/parallel_runs.h"
#include "engine/experiments/trace_recorder.h"
#include "engine/geometry/rotation.h"
#include "engine/pipeline/first_guess.h"
#include "engine/pipeline/rig_hardware.h"

namespace helical {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kCoveredFromS = 13.0;
constexpr double kSessionS = 25.0;
constexpr double kLimitS = 45.0;  // who has not landed then never will
constexpr double kOutliers = 0.01, kLostMarkers = 0.03;
const CameraId kCoveredCamera = cameraId(1), kLearner = cameraId(2);

RigConfig configured(const RigConfig& paper_rig, const MatsukawaArm& arm, std::uint64_t seed, bool images) {
  RigConfig rig = paper_rig;
  rig.tracker = arm.tracker;
  // Frozen after the switch, with the paper's tracker, too, nothing is left of the difference between A and
  // B.
  rig.learn_from_own_pose = arm.tracker == "paper";
  rig.simulation.seed = seed;
  rig.simulation.images = images;
  rig.simulation.noise.outliers = kOutliers;
  rig.simulation.noise.lost_markers = kLostMarkers;
  rig.simulation.occlusions = {{kCoveredCamera, kCoveredFromS, kLimitS}};
  if (arm.calibrator.empty()) {
    // Left to itself it would find its place.
    rig.simulation.occlusions.push_back({kLearner, 0.0, kLimitS});
    return rig;
  }
  rig.calibrator = arm.calibrator;
  giveFirstGuesses(rig, toRadians(kFirstGuessErrorDeg), kFirstGuessErrorM, seed, true);
  return rig;
}

/// Reduces a flight's ticks to what is reported.
class FlightReducer {
 public:
  FlightReducer(const RigConfig& rig, bool learns)
      : learns_(learns), true_camera_from_world_(trueCameraFromWorld(rig, kLearner)) {
    flight_.camera3_error_m = flight_.camera3_error = kNaN;
    flight_.camera3_end_error_m = flight_.camera3_end_error = kNaN;
  }

  void add(const EngineSnapshot& tick) {
    if (toSeconds(tick.time) < kCoveredFromS || !rotorsTurn(tick.phase) || tick.verdict.crashed) return;
    const CameraSnapshot& camera = tick.cameras[static_cast<std::size_t>(kLearner.index())];
    if (learns_) addCameraError(camera);
    if (camera.track.exposure != newest_frame_) {
      newest_frame_ = camera.track.exposure;
      ++flight_.camera3_frames;
      flight_.camera3_used += camera.track.selected_count > 0;
    }
    if (tick.has_truth && inTheAir(tick.phase))
      pose_error_.add(
          (tick.tracked.state.world_from_body.translation - tick.truth.world_from_body.translation).norm());
  }

  MatsukawaFlight result(const FlightRun& run, std::uint64_t seed) {
    flight_.seed = seed;
    flight_.outcome = outcomeOf(run.last.verdict, run.score.failsafes());
    flight_.pose_rms_after_cover = pose_error_.count() > 0 ? pose_error_.value() : kNaN;
    return flight_;
  }

 private:
  void addCameraError(const CameraSnapshot& camera) {
    const CameraError error = cameraError(camera.estimate.camera_from_world, true_camera_from_world_);
    flight_.camera3_end_error_m = error.position;
    flight_.camera3_end_error = error.orientation;
    if (!std::isnan(flight_.camera3_error_m)) return;
    flight_.camera3_error_m = error.position;
    flight_.camera3_error = error.orientation;
  }

  bool learns_;
  RigidTransform true_camera_from_world_;
  MatsukawaFlight flight_;
  RunningRms pose_error_;
  TimeNs newest_frame_ = -1;
};

void flyOnce(const RigConfig& rig, const FlightPlan& plan, std::uint64_t seed, MatsukawaResult& result,
             std::size_t place) {
  FlightReducer reducer(rig, !result.arm.calibrator.empty());
  std::optional<TraceRecorder> recorder;
  if (place == 0) recorder.emplace(rig, kLearner);
  const FlightRun run = runFlight(rig, plan, kLimitS, false, [&](const EngineSnapshot& tick) {
    reducer.add(tick);
    if (recorder) recorder->add(tick);
  });
  result.flights[place] = reducer.result(run, seed);
  if (!recorder) return;
  result.trace = recorder->take();
  result.trace.name = result.arm.name.size() == 1 ? "experiment " + result.arm.name : result.arm.name;
}

}  // namespace

std::vector<MatsukawaArm> matsukawaArms() {
  std::vector<MatsukawaArm> arms;
  for (const char* tracker : {"paper", "helical"}) {
    arms.push_back({"camera-1-alone", tracker, ""});
    arms.push_back({"A", tracker, "gauss-newton"});
    arms.push_back({"B", tracker, "particle-filter"});
    arms.push_back({"default", tracker, RigConfig().calibrator});
  }
  return arms;
}

int MatsukawaResult::landed() const {
  return static_cast<int>(std::count_if(flights.begin(), flights.end(), [](const MatsukawaFlight& flight) {
    return flight.outcome == "landed";
  }));
}

double MatsukawaResult::camera3UsedShare() const {
  std::uint64_t frames = 0, used = 0;
  for (const MatsukawaFlight& flight : flights) {
    frames += flight.camera3_frames;
    used += flight.camera3_used;
  }
  return frames > 0 ? static_cast<double>(used) / static_cast<double>(frames) : 0.0;
}

Spread MatsukawaResult::spread(double MatsukawaFlight::*figure) const {
  std::vector<double> values;
  for (const MatsukawaFlight& flight : flights)
    if (!std::isnan(flight.*figure)) values.push_back(flight.*figure);
  return {quantile(values, 0.5), quantile(values, 0.9)};
}

std::vector<MatsukawaResult> flyMatsukawa2010(
    const RigConfig& rig, const FlightPlan& plan, const MatsukawaOptions& options,
    const std::function<void(double, const std::string&)>& progress) {
  FlightPlan session = plan;
  landWithin(session, kSessionS);
  std::vector<MatsukawaResult> results;
  const auto arms = matsukawaArms();
  for (const MatsukawaArm& arm : arms) {
    MatsukawaResult result{arm, {}, {}};
    result.flights.resize(static_cast<std::size_t>(options.runs));
    const std::string what = "arm " + arm.name + ", " + arm.tracker + " tracker";
    const auto before = static_cast<double>(results.size());
    forEachRun(
        options.runs,
        [&](int run) {
          const std::uint64_t seed = options.seed + static_cast<std::uint64_t>(run);
          flyOnce(configured(rig, arm, seed, options.images), session, seed, result,
                  static_cast<std::size_t>(run));
        },
        [&](int done) {
          progress((before + static_cast<double>(done) / options.runs) / static_cast<double>(arms.size()),
                   what);
        });
    results.push_back(std::move(result));
  }
  return results;
}

}  // namespace helical
