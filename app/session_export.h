#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "engine/session/export_selection.h"

namespace helical {

struct SessionExport {
  std::vector<std::filesystem::path> files;
  std::vector<std::string> warnings;
};

/// Hears of 0..1 and of the step at hand; ends the export by throwing ExportCancelled.
using StepProgress = std::function<void(double, const std::string&)>;

/// Carries out an order but for the film of the 3D view, which needs a window's thread. Figures need Qt's
/// application object. Any thread, one at a time. Throws Error.
SessionExport exportSession(const ExportOrder& order, const StepProgress& progress);

}  // namespace helical
