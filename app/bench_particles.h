#pragma once

namespace CLI {
class App;
}

namespace helical {

/// Adds `helical-bench particles`: the particle filter that calibrates a camera beside the same filter with
/// its likelihood through cv::projectPoints.
void addParticlesBench(CLI::App& app);

}  // namespace helical
