#pragma once

namespace CLI {
class App;
}

namespace helical {

/// Adds `helical calibrate` with its sub-commands.
void addCalibrateCommand(CLI::App& app, int& exit_code);

/// Adds `calibrate convert`: other programs' camera files in and out.
void addCalibrateConvertCommand(CLI::App& calibrate, int& exit_code);

/// Adds `calibrate intrinsics`: one camera's intrinsics from views of a board.
void addCalibrateIntrinsicsCommand(CLI::App& calibrate, int& exit_code);

/// Adds `calibrate rig`: camera poses from recorded points.
void addCalibrateRigCommand(CLI::App& calibrate, int& exit_code);

}  // namespace helical
