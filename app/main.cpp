#include <CLI/CLI.hpp>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "app/calibrate.h"
#include "app/compare.h"
#include "app/detect.h"
#include "app/devices.h"
#include "app/doctor.h"
#include "app/experiment.h"
#include "app/export.h"
#include "app/fly.h"
#include "app/option_values.h"
#include "app/recover.h"
#include "app/replay.h"
#include "app/serve.h"
#include "app/transmitter.h"
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

struct WindowArguments {
  std::string rig_file;
  std::string plan = "demonstration";
  bool no_record = false;
  std::vector<std::string> session_images;
  std::string session;
};

int openWindow(const WindowArguments& arguments, int argc, char** argv) {
#ifdef HELICAL_HAS_WINDOW
  if (!arguments.session.empty()) return helical::runSessionWindow(argc, argv, arguments.session);
  const std::filesystem::path rig = arguments.rig_file.empty()
                                        ? helical::resourceFolder() / "rigs" / "paper.toml"
                                        : std::filesystem::path(arguments.rig_file);
  helical::WindowFlight flight;
  flight.rig = helical::loadRig(rig);
  flight.plan_file = helical::planPath(arguments.plan);
  flight.plan = helical::loadPlan(flight.plan_file);
  flight.demonstration = arguments.rig_file.empty();
  flight.record = !arguments.no_record;
  flight.images = helical::parseImageRecordings(arguments.session_images, flight.rig);
  return helical::runWindow(argc, argv, std::move(flight));
#else
  static_cast<void>(arguments), static_cast<void>(argc), static_cast<void>(argv);
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
  WindowArguments window;
  const std::vector<CLI::Option*> of_window{
      app.add_option("--rig", window.rig_file, "Rig file for the window"),
      app.add_option("--plan", window.plan,
                     "Flight plan for the window: demonstration, hover, waypoints, or a file"),
      app.add_option("--session", window.session, "A recorded flight to look at in the window"),
      app.add_flag("--no-record", window.no_record, "The window's flight leaves no session behind"),
      app.add_option("--session-images", window.session_images,
                     "[CAM=]off|jpeg|lossless[@HZ]: images in the window's record, of one camera or all")};
  int exit_code = 0;
  // They belong to the window: a flight on another rig than the one that was named would be a bad surprise.
  app.parse_complete_callback([&] {
    for (const CLI::Option* option : of_window)
      if (!app.get_subcommands().empty() && option->count() > 0)
        throw helical::Error(ErrorKind::kInput, option->get_name() + " before a sub-command is the window's",
                             {}, "give it behind the sub-command: helical fly --rig FILE");
  });
  helical::addFlyCommand(app, exit_code);
  helical::addCalibrateCommand(app, exit_code);
  helical::addCompareCommand(app, exit_code);
  helical::addDetectCommand(app, exit_code);
  helical::addDevicesCommand(app, exit_code);
  helical::addDoctorCommand(app, exit_code);
  helical::addExperimentCommand(app, exit_code);
  helical::addExportCommand(app, exit_code);
  helical::addRecoverCommand(app, exit_code);
  helical::addReplayCommand(app, exit_code);
  helical::addServeCommand(app, exit_code);
  helical::addTransmitterCommand(app, exit_code);
  app.require_subcommand(0, 1);
  try {
    app.parse(argc, argv);
    if (app.get_subcommands().empty()) exit_code = openWindow(window, argc, argv);
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
