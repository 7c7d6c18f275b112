#pragma once

namespace CLI {
class App;
}

namespace helical {

/// Adds `helical-bench session`: what recording costs a flight in real time, in turn with flights that nobody
/// records, and how soon a long session opens and stands where somebody scrubs to.
void addSessionBench(CLI::App& app);

}  // namespace helical
