#pragma once

#include <filesystem>

#include "engine/config/rig_config.h"
#include "engine/flight/flight_plan.h"
#include "engine/pipeline/flight_tap.h"

namespace helical {

/// Takes off as the plan says and flies for so long, in real time, in the engine's own threads; how it stood at
/// the end. `recorder`, if given, sees the flight, its cameras' images as the mosaics (RGGB) that industrial cameras
/// deliver; the mosaics are made without a recorder, too, so that making them makes no difference.
EngineSnapshot flyForBench(const RigConfig& rig, const FlightPlan& plan, double seconds, FlightTap* recorder);

/// Takes a file out of the page cache, as far as the system lets us: the next reader gets it from the disk.
void forgetFile(const std::filesystem::path& file);

/// A new folder inside `parent`, gone with this.
class ScratchFolder {
 public:
  explicit ScratchFolder(const std::filesystem::path& parent);
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace helical
