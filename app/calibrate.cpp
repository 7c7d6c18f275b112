#include "app/calibrate.h"

#include <CLI/CLI.hpp>

namespace helical {

void addCalibrateCommand(CLI::App& app, int& exit_code) {
  CLI::App* calibrate = app.add_subcommand("calibrate", "From a bag of cameras to a calibrated rig");
  calibrate->require_subcommand(1);
  addCalibrateIntrinsicsCommand(*calibrate, exit_code);
  addCalibrateRigCommand(*calibrate, exit_code);
  addCalibrateConvertCommand(*calibrate, exit_code);
}

}  // namespace helical
