#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "engine/experiments/calibration_study.h"
#include "engine/experiments/endurance_study.h"
#include "engine/experiments/knock_study.h"

namespace helical {

/// Flights of a minute with outliers in which nobody touches a camera.
struct QuietCondition {
  std::string name;
  double outliers = 0.0;
  int minutes = 0;
};

/// Everything that `helical experiment calibration` found; what was not asked for is absent.
struct CalibrationReport {
  int runs = 0;
  std::uint64_t seed = 0;
  std::vector<CalibrationResult> conditions;
  std::vector<KnockResult> knocks;
  std::vector<std::pair<QuietCondition, QuietResult>> quiet;
  std::optional<ManyCamerasResult> sixteen;
  std::optional<MemoryResult> memory;
};

std::string calibrationReportJson(const CalibrationReport& report);
std::string calibrationReportText(const CalibrationReport& report);

}  // namespace helical
