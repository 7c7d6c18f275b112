#include "engine/experiments/endurance_study.h"

#include <malloc.h>

#include <algorithm>
#include <memory>
#include <vector>

#include "engine/calibration/calibrator_factory.h"
#include "engine/experiments/calibration_field.h"
#include "engine/experiments/calibration_study.h"
#include "engine/experiments/thread_time.h"
#include "engine/pipeline/lock_step.h"

namespace helical {
namespace {

constexpr int kCameras = 16;
constexpr double kWarmUpS = 60.0;

double bytesInUse() {
  const struct mallinfo2 info = mallinfo2();
  return static_cast<double>(info.uordblks + info.hblkhd);
}

void calibrateAll(std::uint64_t seed, std::vector<double>& frames_us) {
  CalibrationFieldOptions options;
  options.markers = MarkerLayout::paper();
  std::vector<CalibrationField> fields;
  std::vector<std::unique_ptr<ExtrinsicCalibrator>> calibrators;
  for (std::uint64_t c = 0; c < kCameras; ++c) {
    fields.push_back(simulateCalibrationField(seed * kCameras + c, options));
    calibrators.push_back(makeCalibrator("joint", {}, fields.back().camera, options.markers, seed));
    calibrators.back()->restart(fields.back().guess);
  }
  for (std::size_t k = 0; k < fields.front().frames.size(); ++k) {
    const double begin = threadMicroseconds();
    for (std::size_t c = 0; c < kCameras; ++c)
      if (fields[c].frames[k].has_pose) calibrators[c]->step(fields[c].frames[k].view());
    frames_us.push_back(threadMicroseconds() - begin);
  }
}

}  // namespace

ManyCamerasResult studySixteenCameras(int rounds, std::uint64_t first_seed,
                                      const std::function<void(int)>& progress) {
  std::vector<double> frames_us;
  for (int i = 0; i < rounds; ++i) {
    calibrateAll(first_seed + static_cast<std::uint64_t>(i), frames_us);
    progress(i + 1);
  }
  ManyCamerasResult result;
  result.cameras = kCameras;
  result.frames = static_cast<int>(frames_us.size());
  for (const double each : frames_us) result.mean_us += each / static_cast<double>(frames_us.size());
  result.slow_us = quantile(std::move(frames_us), 0.999);
  return result;
}

MemoryResult studyMemory(const RigConfig& shipped, double duration_s, std::uint64_t seed,
                         const std::function<void(double)>& progress) {
  RigConfig rig = shipped;
  rig.simulation.seed = seed;
  rig.simulation.images = false;
  FlightPlan plan;
  plan.land_at_s = duration_s + 10.0;
  const double before = bytesInUse();
  LockStep flight(rig, plan);
  OperatorCommands commands;
  MemoryResult result;
  double next_s = kWarmUpS;
  for (;;) {
    const EngineSnapshot& now = flight.tick(commands);
    commands.arm = commands.take_off = now.phase == FlightPhase::kIdle && now.failing_checks == 0;
    result.flown_s = toSeconds(now.time);
    if (result.flown_s >= next_s) {
      result.at_the_end = bytesInUse() - before;
      if (next_s == kWarmUpS) result.after_a_minute = result.at_the_end;
      result.most = std::max(result.most, result.at_the_end);
      next_s += 1.0;
      progress(result.flown_s / duration_s);
    }
    if (result.flown_s >= duration_s || now.verdict.crashed) return result;
  }
}

}  // namespace helical
