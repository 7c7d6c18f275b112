#pragma once

namespace CLI {
class App;
}

namespace helical {

/// Adds `helical doctor`: what on this machine would get in the way, and the cure. Sets `exit_code` to 1 when something
/// would, to 3 when a camera or the transmitter of the rig is missing.
void addDoctorCommand(CLI::App& app, int& exit_code);

}  // namespace helical
