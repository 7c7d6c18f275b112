#pragma once

namespace CLI {
class App;
}

namespace helical {

/// Adds `helical-bench markers`: the extractor beside the plain OpenCV pipeline and beside one read of the
/// frame.
void addMarkersBench(CLI::App& app);

}  // namespace helical
