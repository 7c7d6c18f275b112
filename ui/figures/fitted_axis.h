#pragma once

#include <vector>

#include "ui/figures/figure.h"

namespace helical::figures {

/// An axis of round ticks (1, 2 or 5 times a power of ten), three to seven of them, that reaches from `low`
/// to `high` at least and over `smallest` in any case.
PlotAxis fittedAxis(const QString& title, double low, double high, double smallest);

/// The same over the values of curves; what lies beyond +-`limit` does not count.
PlotAxis fittedAxis(const QString& title, const std::vector<Curve>& curves, double smallest, double limit);

}  // namespace helical::figures
