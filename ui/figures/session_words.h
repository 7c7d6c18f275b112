#pragma once

#include <QString>
#include <vector>

#include "engine/session/session_summary.h"

namespace helical::figures {

/// The report's pages of text as HTML: set-up, conditions, outcome, errors, cameras and their calibration,
/// failsafes, events. Pure.
QString sessionInWords(const SessionSummary& session);

/// What several flights have in common to be told apart by, as one table. Pure.
QString comparisonInWords(const std::vector<SessionSummary>& sessions);

}  // namespace helical::figures
