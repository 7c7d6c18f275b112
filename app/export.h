#pragma once

namespace CLI {
class App;
}

namespace helical {

/// Adds `helical export`: a session as files for other programs.
void addExportCommand(CLI::App& app, int& exit_code);

}  // namespace helical
