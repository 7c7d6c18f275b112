#pragma once

namespace CLI {
class App;
}

namespace helical {

/// Adds `helical detect`: the markers in every frame of an image, a video or a folder of images, as CSV.
void addDetectCommand(CLI::App& app, int& exit_code);

}  // namespace helical
