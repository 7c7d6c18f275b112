#include "engine/experiments/knock_study.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/experiments/calibration_study.h"
#include "engine/experiments/flight_run.h"
#include "engine/experiments/parallel_runs.h"
#include "engine/pipeline/flight_score.h"
#include "engine/pipeline/lock_step.h"

namespace helical {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr double kWatchedS = 5.0;
constexpr double kMinuteS = 60.0;

/// Hovers until told to stop looking.
template <typename Listener>
void hover(const RigConfig& rig, double until_s, const Listener& listener) {
  FlightPlan plan;
  plan.land_at_s = until_s + 10.0;
  LockStep flight(rig, plan);
  OperatorCommands commands;
  for (;;) {
    const EngineSnapshot& now = flight.tick(commands);
    commands.arm = commands.take_off = now.phase == FlightPhase::kIdle && now.failing_checks == 0;
    listener(now);
    if (toSeconds(now.time) >= until_s || now.verdict.crashed) return;
  }
}

KnockRun knockOnce(RigConfig rig, const KnockCondition& condition, std::uint64_t seed) {
  const auto knocked = static_cast<std::size_t>(seed % rig.cameras.size());
  rig.simulation.seed = seed;
  rig.simulation.images = false;
  const Bump bump{cameraId(static_cast<int>(knocked)), kKnockedAtS, condition.angle, condition.distance,
                  condition.across};
  rig.simulation.bumps = {bump};
  KnockRun run{kInfinite, 0.0, kInfinite, 0};
  hover(rig, kKnockedAtS + kWatchedS, [&](const EngineSnapshot& now) {
    const double since_s = toSeconds(now.time) - kKnockedAtS;
    const CameraSnapshot& camera = now.cameras[knocked];
    run.others_found = 0;
    for (std::size_t i = 0; i < rig.cameras.size(); ++i)
      if (i != knocked) run.others_found += now.cameras[i].knocks_found;
    run.others_found += since_s < 0.0 ? camera.knocks_found : std::max(0, camera.knocks_found - 1);
    if (since_s < 0.0) return;
    if (camera.knocks_found > 0) {
      run.found_s = std::min(run.found_s, since_s);
      if (std::isinf(run.again_s) && camera.estimate.status == CameraStatus::kCalibrated) run.again_s = since_s;
    }
    const CameraError error = cameraError(camera.estimate.camera_from_world, camera.true_camera_from_world);
    if (error.position > kGoodPlaceM || error.orientation > kGoodPlaceRad) run.back_s = since_s;
  });
  if (run.back_s > kWatchedS - 0.1) run.back_s = kInfinite;
  return run;
}

int alarmsInAMinute(RigConfig rig, double outliers, std::uint64_t seed) {
  rig.simulation.seed = seed;
  rig.simulation.images = false;
  rig.simulation.noise.outliers = outliers;
  int alarms = 0;
  hover(rig, kMinuteS, [&](const EngineSnapshot& now) {
    alarms = 0;
    for (std::size_t i = 0; i < rig.cameras.size(); ++i) alarms += now.cameras[i].knocks_found;
  });
  return alarms;
}

Interval quantileOf(const std::vector<KnockRun>& runs, double KnockRun::* time, double fraction) {
  std::vector<double> values;
  for (const KnockRun& run : runs) values.push_back(run.*time);
  return quantileInterval(values, fraction);
}

}  // namespace

Proportion KnockResult::foundInTime() const {
  const auto found = std::count_if(runs.begin(), runs.end(),
                                   [&](const KnockRun& run) { return run.found_s <= condition.limit_s; });
  return proportion(static_cast<int>(found), static_cast<int>(runs.size()));
}

Interval KnockResult::foundQuantile(double fraction) const {
  return quantileOf(runs, &KnockRun::found_s, fraction);
}

Interval KnockResult::backQuantile(double fraction) const {
  return quantileOf(runs, &KnockRun::back_s, fraction);
}

Interval KnockResult::againQuantile(double fraction) const {
  return quantileOf(runs, &KnockRun::again_s, fraction);
}

int KnockResult::othersFound() const {
  int sum = 0;
  for (const KnockRun& run : runs) sum += run.others_found;
  return sum;
}

std::vector<KnockCondition> knockConditions() {
  return {{"knock-5deg", toRadians(5.0), 0.05, 0.25},
          {"knock-0.2deg", toRadians(0.2), 0.005, 0.1, true},
          {"knock-0.05deg", toRadians(0.05), 0.001, 1.0, true}};
}

KnockResult studyKnocks(const RigConfig& rig, const KnockCondition& condition, int runs, std::uint64_t first_seed,
                        const std::function<void(int)>& progress) {
  KnockResult result;
  result.condition = condition;
  result.runs = runSeeds(runs, first_seed, progress,
                         [&](std::uint64_t seed) { return knockOnce(rig, condition, seed); });
  return result;
}

QuietResult studyFalseAlarms(const RigConfig& rig, double outliers, int minutes, std::uint64_t first_seed,
                             const std::function<void(int)>& progress) {
  const std::vector<int> alarms = runSeeds(
      minutes, first_seed, progress, [&](std::uint64_t seed) { return alarmsInAMinute(rig, outliers, seed); });
  QuietResult result;
  for (const int each : alarms) result.alarms += each;
  result.camera_hours = minutes * kMinuteS / 3600.0 * static_cast<double>(rig.cameras.size());
  return result;
}

}  // namespace helical
