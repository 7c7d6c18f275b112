#pragma once

#include "engine/config/rig_config.h"
#include "engine/config/toml_table.h"

namespace helical {

/// The tables of a rig file that set an options struct each: keys with units to members in SI. All throw as
/// TomlTable, for unknown keys and for what the struct's own validate() refuses.
void readHelicopter(TomlTable table, RigConfig& rig);
void readMarkerOptions(TomlTable table, MarkerOptions& options);
void readTrackerOptions(TomlTable table, TrackerOptions& options);
void readControllerOptions(TomlTable table, ControllerOptions& options);
void readSupervisorOptions(TomlTable table, SupervisorOptions& options);
void readSimulationOptions(TomlTable& table, SimulationOptions& options);
/// The method and what users set of all methods.
void readCalibration(TomlTable table, RigConfig& rig);

}  // namespace helical
