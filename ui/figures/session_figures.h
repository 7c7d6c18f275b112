#pragma once

#include <vector>

#include "engine/session/session_summary.h"
#include "ui/figures/figure.h"

namespace helical::figures {

/// A recorded flight in the manner of the paper's figures: fig06 and fig07 (generalized coordinates and their
/// references), fig08 (selected image features), fig09 and fig10 (calibration errors of the cameras that
/// learn, where the truth is known), fig11 (the features where cameras were covered), and beyond the paper
/// `tracking`, `calibration`, `calibration_orientation`, `residuals`, `sample_size`, `sticks`, `latency` and
/// `latency_histogram`. A figure without any data is left out. Axes fit the data. Pure.
std::vector<Figure> sessionFigures(const SessionSummary& session);

}  // namespace helical::figures
