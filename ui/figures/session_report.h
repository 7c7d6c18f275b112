#pragma once

#include <filesystem>
#include <vector>

#include "engine/session/session_summary.h"

namespace helical::figures {

/// Writes one PDF about a recorded flight, A4: set-up, conditions, outcome, tracking and control errors,
/// cameras and the quality of their calibration, failsafes and events, then its figures, two a page. The file
/// appears whole or not at all. Throws `Error` with the file and a cure. Needs a QGuiApplication; one thread
/// at a time.
std::filesystem::path writeSessionReport(const SessionSummary& session, const std::filesystem::path& folder);

/// Likewise one about several flights: the table that tells them apart, then their figures over each other.
std::filesystem::path writeComparisonReport(const std::vector<SessionSummary>& sessions,
                                            const std::filesystem::path& file);

}  // namespace helical::figures
