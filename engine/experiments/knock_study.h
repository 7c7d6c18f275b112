#pragma once

#include <functional>
#include <string>
#include <vector>

#include "engine/config/rig_config.h"
#include "engine/experiments/statistics.h"

namespace helical {

/// Flights in which one camera of three or more in control is knocked at `kKnockedAtS`, image-free.
struct KnockCondition {
  std::string name;
  double angle = 0.0;     ///< rad
  double distance = 0.0;  ///< m
  double limit_s = 0.0;   ///< within which it should be found
  bool across = false;    ///< about an axis perpendicular to the line of sight; else about any
};
inline constexpr double kKnockedAtS = 10.0;

/// What became of one knock; times count from it and are infinite for what did not happen within 5 s.
struct KnockRun {
  double found_s = 0.0;
  double back_s = 0.0;   ///< since then the camera's estimate stays within 1 cm and 0.5 degrees
  double again_s = 0.0;  ///< the camera is back in the control set
  int others_found = 0;  ///< alarms of cameras that nobody touched, and of this one before the knock
};

struct KnockResult {
  KnockCondition condition;
  std::vector<KnockRun> runs;

  Proportion foundInTime() const;
  Interval foundQuantile(double fraction) const;
  Interval backQuantile(double fraction) const;
  Interval againQuantile(double fraction) const;
  int othersFound() const;
};

std::vector<KnockCondition> knockConditions();

/// Seeds `first_seed` .. `first_seed` + `runs` - 1 on all cores; the knocked camera is another one each time. `rig`:
/// simulated, every camera calibrated.
KnockResult studyKnocks(const RigConfig& rig, const KnockCondition& condition, int runs, std::uint64_t first_seed,
                        const std::function<void(int)>& progress);

/// Flights in which nobody touches a camera.
struct QuietResult {
  double camera_hours = 0.0;  ///< with every camera in control
  int alarms = 0;
};

/// Flights of a minute in gusts with this share of the centroids thrown aside.
QuietResult studyFalseAlarms(const RigConfig& rig, double outliers, int minutes, std::uint64_t first_seed,
                             const std::function<void(int)>& progress);

}  // namespace helical
