#include "app/export.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "engine/base/error.h"
#include "engine/base/log.h"
#include "engine/session/csv_export.h"

namespace helical {
namespace {

struct Arguments {
  std::string session;
  std::vector<std::string> formats;
  std::string out;
};

/// Known before anything is written.
void requireFormats(const std::vector<std::string>& formats) {
  for (const auto& format : formats) {
    if (format == "csv") continue;
    const bool planned = format == "mp4" || format == "pdf" || format == "png";
    throw Error(
        ErrorKind::kInput,
        planned ? "sessions are not exported as " + format + " yet" : "unknown format '" + format + "'",
        "--format", "give --format csv");
  }
}

void warnOfDamage(const McapReader& session, const McapReader::Reading& reading) {
  if (!session.complete())
    log(LogLevel::kWarning, session.file().string() + " was cut off: `helical recover` mends it");
  if (reading.damaged_chunks > 0)
    log(LogLevel::kWarning, session.file().string() + ": " + std::to_string(reading.damaged_chunks) +
                                " damaged chunks are left out");
}

int exportSession(const Arguments& arguments) {
  requireFormats(arguments.formats);
  McapReader session(arguments.session);
  const CsvExport result = exportCsv(session, arguments.out);
  warnOfDamage(session, result.reading);
  for (const auto& file : result.files) std::printf("%s\n", file.string().c_str());
  return 0;
}

}  // namespace

void addExportCommand(CLI::App& app, int& exit_code) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand("export", "A recorded session as files for other programs");
  command->add_option("SESSION", arguments->session, "The session's MCAP file")->required();
  command->add_option("--format", arguments->formats, "csv: one table a stream")->delimiter(',')->required();
  command->add_option("--out", arguments->out, "Folder for the files")->required();
  command->callback([arguments, &exit_code] { exit_code = exportSession(*arguments); });
}

}  // namespace helical
