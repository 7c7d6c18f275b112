#pragma once

#include <CLI/App.hpp>

namespace helical {

/// `helical-bench pipeline`: what the window costs the flight. Needs a display.
void addPipelineBench(CLI::App& app);

}  // namespace helical
