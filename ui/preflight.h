#pragma once

#include <QString>
#include <vector>

#include "engine/config/rig_config.h"
#include "engine/pipeline/snapshot.h"

namespace helical {

enum class Readiness { kGood, kCaution, kBad };

/// One line of the pre-flight list.
struct PreflightItem {
  Readiness readiness = Readiness::kGood;
  QString name;
  QString detail;  ///< what is so, and for what is not good what to do
};

/// Everything that must be right before a take-off, the failing and the good alike; kBad prevents it or would
/// end it soon, kCaution is worth knowing.
std::vector<PreflightItem> preflightList(const RigConfig& rig, const EngineSnapshot& snapshot);

/// The worst of them.
Readiness worstOf(const std::vector<PreflightItem>& items);

}  // namespace helical
