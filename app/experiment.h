#pragma once

namespace CLI {
class App;
}

namespace helical {

/// Adds `helical experiment`, the group of studies over many seeds.
void addExperimentCommand(CLI::App& app, int& exit_code);

/// Adds `correspondence` to the group: labellings, time and success of naming centroids over random views.
/// Sets `exit_code` to 1 when theorem 1's bound was broken.
void addCorrespondenceExperiment(CLI::App& experiments, int& exit_code);

/// Adds `matsukawa2010` to the group: the paper's experiments over many seeds, its table and figures.
void addMatsukawa2010Experiment(CLI::App& experiments, int& exit_code);

/// Adds `calibration` to the group: how near every method comes to the Cramer-Rao bound, and how fast.
void addCalibrationExperiment(CLI::App& experiments, int& exit_code);

/// Adds `faults` to the group: random faults in flight, and what became of them. Sets `exit_code` to 1 when something
/// happened that must not.
void addFaultsExperiment(CLI::App& experiments, int& exit_code);

}  // namespace helical
