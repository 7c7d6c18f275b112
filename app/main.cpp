#include <CLI/CLI.hpp>
#include <cstdio>
#include <string>

#include "app/detect.h"
#include "app/experiment.h"
#include "app/export.h"
#include "app/fly.h"
#include "app/recover.h"
#include "app/replay.h"
#include "app/serve.h"
#include "engine/base/error.h"
#include "engine/base/log.h"
#ifdef HELICAL_HAS_WINDOW
#include "app/window.h"
#include "engine/config/plan_file.h"
#include "engine/config/resource_files.h"
#include "engine/config/rig_file.h"
#endif

namespace {

using helical::ErrorKind;

constexpr int kFailed = 1, kBadInput = 2, kDeviceMissing = 3;

int exitCode(ErrorKind kind) {
  switch (kind) {
    case ErrorKind::kInput:
      return kBadInput;
    case ErrorKind::kDevice:
      return kDeviceMissing;
    case ErrorKind::kSystem:
      return kFailed;
  }
  return kFailed;
}

int openWindow(const std::string& rig_file, const std::string& plan, int argc, char** argv) {
#ifdef HELICAL_HAS_WINDOW
  const std::filesystem::path rig =
      rig_file.empty() ? helical::resourceFolder() / "rigs" / "paper.toml" : std::filesystem::path(rig_file);
  return helical::runWindow(argc, argv, helical::loadRig(rig), helical::loadPlan(helical::planPath(plan)),
                            rig_file.empty());
#else
  static_cast<void>(rig_file), static_cast<void>(plan), static_cast<void>(argc), static_cast<void>(argv);
  throw helical::Error(ErrorKind::kInput, "this build has no window", {},
                       "use a sub-command such as `helical fly`, or build the preset release");
#endif
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Helical: ground control for small helicopters that carry no sensors", "helical");
  app.set_version_flag("--version", "helical " HELICAL_VERSION);
  app.footer(
      "Without a sub-command: the window on the simulated rig.\n"
      "Exit codes: 0 done, 1 the flight or check failed, 2 bad usage or input, 3 a device is missing or "
      "lost.");
  std::string rig_file, plan = "demonstration";
  app.add_option("--rig", rig_file, "Rig file for the window");
  app.add_option("--plan", plan, "Flight plan for the window: demonstration, hover, waypoints, or a file");
  int exit_code = 0;
  // These two belong to the window: a flight on another rig than the one that was named would be a bad
  // surprise.
  app.parse_complete_callback([&] {
    if (!app.get_subcommands().empty() && (app.count("--rig") > 0 || app.count("--plan") > 0))
      throw helical::Error(ErrorKind::kInput, "--rig and --plan before a sub-command are the window's", {},
                           "give them behind the sub-command: helical fly --rig FILE");
  });
  helical::addFlyCommand(app, exit_code);
  helical::addDetectCommand(app, exit_code);
  helical::addExperimentCommand(app, exit_code);
  helical::addExportCommand(app, exit_code);
  helical::addRecoverCommand(app, exit_code);
  helical::addReplayCommand(app, exit_code);
  helical::addServeCommand(app, exit_code);
  app.require_subcommand(0, 1);
  try {
    app.parse(argc, argv);
    if (app.get_subcommands().empty()) exit_code = openWindow(rig_file, plan, argc, argv);
  } catch (const CLI::ParseError& error) {
    const int code = app.exit(error);
    return code == 0 ? 0 : kBadInput;
  } catch (const helical::Error& error) {
    helical::log(helical::LogLevel::kError, error.what());
    return exitCode(error.kind());
  } catch (const std::exception& error) {
    helical::log(helical::LogLevel::kError, error.what());
    return kFailed;
  }
  return exit_code;
}
