#include "app/export.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/progress.h"
#include "app/session_export.h"
#include "engine/base/error.h"
#include "engine/base/log.h"
#ifdef HELICAL_HAS_WINDOW
#include "app/scene_export.h"
#include "ui/figures/offscreen_application.h"
#endif

namespace helical {
namespace {

struct Arguments {
  std::string session;
  std::vector<std::string> formats;
  std::vector<std::string> streams;
  double from_s = 0.0;
  double to_s = -1.0;  ///< negative: to the end
  std::string out;
};

bool asksFor(const Arguments& arguments, const char* format) {
  return std::find(arguments.formats.begin(), arguments.formats.end(), format) != arguments.formats.end();
}

/// Known before anything is written.
void requireFormats(const Arguments& arguments) {
  for (const auto& format : arguments.formats)
    if (format != "csv" && format != "mp4" && format != "pdf" && format != "png")
      throw Error(ErrorKind::kInput, "unknown format '" + format + "'", "--format",
                  "give csv, mp4, pdf or png");
  if (arguments.to_s >= 0.0 && arguments.to_s <= arguments.from_s)
    throw Error(ErrorKind::kInput, "the span ends before it begins", "--to", "give a later time than --from");
#ifndef HELICAL_HAS_WINDOW
  if (asksFor(arguments, "pdf") || asksFor(arguments, "png"))
    throw Error(ErrorKind::kInput, "pdf and png need figures, and this build draws none", "--format",
                "build the preset release, or give csv or mp4");
#endif
}

ExportOrder orderOf(const Arguments& arguments) {
  ExportOrder order;
  order.session = arguments.session;
  order.folder = arguments.out;
  order.tables = asksFor(arguments, "csv");
  order.topics = {arguments.streams.begin(), arguments.streams.end()};
  order.films = asksFor(arguments, "mp4");
  order.png = asksFor(arguments, "png");
  order.pdf = asksFor(arguments, "pdf");
  order.span.from = fromSeconds(arguments.from_s);
  if (arguments.to_s >= 0.0) order.span.to = fromSeconds(arguments.to_s);
  return order;
}

int runExport(const Arguments& arguments) {
  requireFormats(arguments);
  ExportOrder order = orderOf(arguments);
#ifdef HELICAL_HAS_WINDOW
  std::optional<SceneApplication> display;  // before any other application object
  if (order.films && SceneApplication::possible()) {
    display.emplace();
    order.scene = true;
  }
  std::optional<figures::OffscreenApplication> figures;
  if (order.png || order.pdf) figures.emplace();
#endif
  SessionExport done;
  {
    Progress progress("Export");
    done = exportSession(order, [&](double share, const std::string& step) { progress.update(share, step); });
#ifdef HELICAL_HAS_WINDOW
    if (order.scene) done.files.push_back(exportScene(order, [&](double share) { progress.update(share, "3D view"); }));
#endif
  }
  for (const auto& warning : done.warnings) log(LogLevel::kWarning, warning);
  for (const auto& file : done.files) std::printf("%s\n", file.string().c_str());
  return 0;
}

}  // namespace

void addExportCommand(CLI::App& app, int& exit_code) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand("export", "A recorded session as files for other programs");
  command->add_option("SESSION", arguments->session, "The session's MCAP file")->required();
  command
      ->add_option("--format", arguments->formats,
                   "csv: a table a stream; png, pdf: figures, pdf also a report; mp4: films of recorded images, and "
                   "where there is an X display of the 3D view")
      ->delimiter(',')
      ->required();
  command->add_option("--streams", arguments->streams, "Tables of these alone: /helicopter/pose,/sticks,...")
      ->delimiter(',');
  command->add_option("--from", arguments->from_s, "Only what was after this time of the session [s]")
      ->check(CLI::NonNegativeNumber);
  command->add_option("--to", arguments->to_s, "Only what was before this time [s]")->check(CLI::PositiveNumber);
  command->add_option("--out", arguments->out, "Folder for the files")->required();
  command->callback([arguments, &exit_code] { exit_code = runExport(*arguments); });
}

}  // namespace helical
