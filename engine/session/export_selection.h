#pragma once

#include <filesystem>
#include <functional>
#include <limits>
#include <set>
#include <string>

#include "engine/base/time.h"

namespace helical {

/// Which time of a session an export is about, in the session's time.
struct ExportSpan {
  TimeNs from = 0;
  TimeNs to = std::numeric_limits<TimeNs>::max();

  bool holds(TimeNs time) const { return time >= from && time <= to; }
};

/// Hears of 0..1. To end an export it throws ExportCancelled, which comes out of the function that was called;
/// files that are not whole are gone then.
using ExportProgress = std::function<void(double)>;

struct ExportCancelled {};

/// What somebody wants of a session.
struct ExportOrder {
  std::filesystem::path session;
  std::filesystem::path folder;
  bool tables = false;
  std::set<std::string> topics;  ///< of tables; all when empty
  bool films = false;            ///< of cameras with images
  bool scene = false;            ///< film of the 3D view
  bool png = false;              ///< figures
  bool pdf = false;              ///< figures and the report
  ExportSpan span;
};

}  // namespace helical
