#pragma once

namespace CLI {
class App;
}

namespace helical {

/// Adds `helical recover`: mends a session that was cut off.
void addRecoverCommand(CLI::App& app, int& exit_code);

}  // namespace helical
