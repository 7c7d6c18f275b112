#pragma once

namespace CLI {
class App;
}

namespace helical {

/// Adds `helical replay`: a recorded flight through the pipeline again, as it was or with other settings.
/// Sets `exit_code` to 1 when the same settings do not give the same result bit for bit.
void addReplayCommand(CLI::App& app, int& exit_code);

}  // namespace helical
