#pragma once

#include <filesystem>

#include "engine/session/session_summary.h"

namespace helical::figures {

/// Writes one PDF about a recorded flight, A4: set-up, conditions, outcome, tracking and control errors,
/// cameras and the quality of their calibration, failsafes and events, then its figures, two a page. The file
/// appears whole or not at all. Throws `Error` with the file and a cure. Needs a QGuiApplication; one thread
/// at a time.
std::filesystem::path writeSessionReport(const SessionSummary& session, const std::filesystem::path& folder);

}  // namespace helical::figures
