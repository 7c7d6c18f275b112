#pragma once

#include <vector>

#include "engine/session/session_summary.h"
#include "ui/figures/figure.h"

namespace helical::figures {

/// Several recorded flights over each other, in the manner of the paper's figures 6 to 11: generalized
/// coordinates and the first flight's references, the errors of the cameras that learn, the error of the
/// tracked pose, latencies; of each flight the selected features (of two: fig08 and fig11). Time counts from
/// when the rotors began to turn, see `commonZeros`. A figure without any data is left out. Pure.
std::vector<Figure> comparisonFigures(const std::vector<SessionSummary>& sessions);

/// How a flight is drawn and called in them: "A: hover-joint".
Stroke comparisonStroke(std::size_t session);
QString comparisonName(const std::vector<SessionSummary>& sessions, std::size_t session);

}  // namespace helical::figures
