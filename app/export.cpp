#include "app/export.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "app/progress.h"
#include "engine/base/error.h"
#include "engine/base/log.h"
#include "engine/session/csv_export.h"
#include "engine/session/video_export.h"
#ifdef HELICAL_HAS_WINDOW
#include "engine/session/session_summary.h"
#include "ui/figures/figure_file.h"
#include "ui/figures/offscreen_application.h"
#include "ui/figures/session_figures.h"
#include "ui/figures/session_report.h"
#endif

namespace helical {
namespace {

using Files = std::vector<std::filesystem::path>;

struct Arguments {
  std::string session;
  std::vector<std::string> formats;
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
#ifndef HELICAL_HAS_WINDOW
  if (asksFor(arguments, "pdf") || asksFor(arguments, "png"))
    throw Error(ErrorKind::kInput, "pdf and png need figures, and this build draws none", "--format",
                "build the preset release, or give csv or mp4");
#endif
}

void warnOfDamage(const McapReader& session, std::uint64_t damaged_chunks) {
  if (!session.complete())
    log(LogLevel::kWarning, session.file().string() + " was cut off: `helical recover` mends it");
  if (damaged_chunks > 0)
    log(LogLevel::kWarning,
        session.file().string() + ": " + std::to_string(damaged_chunks) + " damaged chunks are left out");
}

void append(Files& files, const Files& more) {
  files.insert(files.end(), more.begin(), more.end());
}

Files exportFilms(const Arguments& arguments) {
  Progress progress("Films");
  const VideoExport films = exportVideo(arguments.session, arguments.out, [&](double done) {
    progress.update(done);
    return true;
  });
  for (const auto& label : films.without_images)
    log(LogLevel::kWarning, "no film of camera " + label + ": the session holds no images of it");
  return films.files;
}

#ifdef HELICAL_HAS_WINDOW
/// Of each figure what was asked for; the report holds all of them.
Files exportFigures(const Arguments& arguments, McapReader& session) {
  Progress progress("Figures");
  const SessionSummary summary = summarize(session, [&](double done) { progress.update(0.5 * done); });
  std::filesystem::create_directories(arguments.out);
  const figures::OffscreenApplication application;
  Files files;
  const auto all = figures::sessionFigures(summary);
  for (std::size_t i = 0; i < all.size(); ++i) {
    progress.update(0.5 + 0.5 * static_cast<double>(i) / static_cast<double>(all.size()),
                    all[i].title.toStdString());
    if (asksFor(arguments, "png")) files.push_back(figures::writePng(all[i], arguments.out));
    if (asksFor(arguments, "pdf")) files.push_back(figures::writePdf(all[i], arguments.out));
  }
  if (asksFor(arguments, "pdf")) files.push_back(figures::writeSessionReport(summary, arguments.out));
  return files;
}
#endif

int exportSession(const Arguments& arguments) {
  requireFormats(arguments);
  McapReader session(arguments.session);
  Files files;
  std::uint64_t damaged_chunks = 0;
  if (asksFor(arguments, "csv")) {
    const CsvExport tables = exportCsv(session, arguments.out);
    damaged_chunks = tables.reading.damaged_chunks;
    append(files, tables.files);
  }
#ifdef HELICAL_HAS_WINDOW
  if (asksFor(arguments, "pdf") || asksFor(arguments, "png"))
    append(files, exportFigures(arguments, session));
#endif
  if (asksFor(arguments, "mp4")) append(files, exportFilms(arguments));
  warnOfDamage(session, damaged_chunks);
  for (const auto& file : files) std::printf("%s\n", file.string().c_str());
  return 0;
}

}  // namespace

void addExportCommand(CLI::App& app, int& exit_code) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand("export", "A recorded session as files for other programs");
  command->add_option("SESSION", arguments->session, "The session's MCAP file")->required();
  command
      ->add_option(
          "--format", arguments->formats,
          "csv: a table a stream; png, pdf: figures, pdf also a report; mp4: films of recorded images")
      ->delimiter(',')
      ->required();
  command->add_option("--out", arguments->out, "Folder for the files")->required();
  command->callback([arguments, &exit_code] { exit_code = exportSession(*arguments); });
}

}  // namespace helical
