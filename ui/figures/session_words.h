#pragma once

#include <QString>

#include "engine/session/session_summary.h"

namespace helical::figures {

/// The report's pages of text as HTML: set-up, conditions, outcome, errors, cameras and their calibration,
/// failsafes, events. Pure.
QString sessionInWords(const SessionSummary& session);

}  // namespace helical::figures
