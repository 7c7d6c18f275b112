#pragma once

namespace CLI {
class App;
}

namespace helical {

/// Adds `helical devices`: the cameras that are plugged in, with what they offer.
void addDevicesCommand(CLI::App& app, int& exit_code);

}  // namespace helical
