#pragma once

namespace CLI {
class App;
}

namespace helical {

/// Adds `helical compare`.
void addCompareCommand(CLI::App& app, int& exit_code);

}  // namespace helical
