#pragma once

namespace CLI {
class App;
}

namespace helical {

/// Adds `helical transmitter calibrate`, which measures a USB transmitter's channels with the operator, and `helical
/// transmitter test`, in which the operator looks, motors off, which way each stick goes. Both write the rig file. Set
/// `exit_code` to 1 when the operator gives up.
void addTransmitterCommand(CLI::App& app, int& exit_code);

}  // namespace helical
