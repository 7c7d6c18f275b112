#include "app/experiment.h"

#include <CLI/CLI.hpp>

namespace helical {

void addExperimentCommand(CLI::App& app, int& exit_code) {
  CLI::App* experiments = app.add_subcommand("experiment", "Studies over many seeds");
  experiments->require_subcommand(1);
  addCorrespondenceExperiment(*experiments, exit_code);
  addMatsukawa2010Experiment(*experiments, exit_code);
  addCalibrationExperiment(*experiments, exit_code);
  addFaultsExperiment(*experiments, exit_code);
}

}  // namespace helical
