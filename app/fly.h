#pragma once

namespace CLI {
class App;
}

namespace helical {

/// Adds `helical fly`: one simulated flight, headless. Sets `exit_code` to 1 when it did not land as planned.
void addFlyCommand(CLI::App& app, int& exit_code);

}  // namespace helical
