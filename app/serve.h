#pragma once

namespace CLI {
class App;
}

namespace helical {

/// Adds `helical serve`: the simulated rig as GigE Vision cameras of this machine, until it is interrupted.
void addServeCommand(CLI::App& app, int& exit_code);

}  // namespace helical
