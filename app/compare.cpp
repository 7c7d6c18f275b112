#include "app/compare.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/progress.h"
#include "engine/base/error.h"
#include "engine/base/log.h"
#include "engine/session/session_comparison.h"
#ifdef HELICAL_HAS_WINDOW
#include "ui/figures/comparison_figures.h"
#include "ui/figures/figure_file.h"
#include "ui/figures/offscreen_application.h"
#include "ui/figures/session_report.h"
#endif

namespace helical {
namespace {

constexpr int kNameWidth = 46;
constexpr int kCellWidth = 18;

struct Arguments {
  std::vector<std::string> sessions;
  std::string out;
  std::string figures;
  bool json = false;
};

std::vector<SessionSummary> readSessions(const std::vector<std::string>& files) {
  Progress progress("Reading " + std::to_string(files.size()) + " sessions");
  auto summaries = summarizeAll(files, [&](double done) { progress.update(done); });
  for (const SessionSummary& summary : summaries)
    if (!summary.complete) log(LogLevel::kWarning, summary.file + " was cut off: compared as far as it goes");
  return summaries;
}

/// Before anything is read.
void requireFigures(const Arguments& arguments) {
  if (arguments.out.empty() && arguments.figures.empty()) return;
#ifndef HELICAL_HAS_WINDOW
  throw Error(ErrorKind::kInput, "this build draws no figures", "--out",
              "build the preset release, or leave out --out and --figures");
#endif
}

void writeFigures(const std::vector<SessionSummary>& summaries, const Arguments& arguments) {
  if (arguments.out.empty() && arguments.figures.empty()) return;
#ifdef HELICAL_HAS_WINDOW
  const figures::OffscreenApplication application;
  if (!arguments.out.empty()) figures::writeComparisonReport(summaries, arguments.out);
  if (arguments.figures.empty()) return;
  std::filesystem::create_directories(arguments.figures);
  for (const figures::Figure& figure : figures::comparisonFigures(summaries))
    figures::writeFigure(figure, arguments.figures);
#else
  static_cast<void>(summaries);
#endif
}

/// Rows are fields of each flight; what is not known is null.
std::string jsonReport(const std::vector<SessionSummary>& summaries, const std::vector<ComparisonRow>& rows,
                       const std::string& out) {
  using Json = nlohmann::ordered_json;
  Json report;
  report["sessions"] = Json::array();
  const std::vector<double> zeros = commonZeros(summaries);
  for (std::size_t i = 0; i < summaries.size(); ++i) {
    Json flight{{"session", summaries[i].file}, {"complete", summaries[i].complete}, {"zero_s", zeros[i]}};
    for (const ComparisonRow& row : rows) {
      if (!row.words.empty())
        flight[row.key] = row.words[i];
      else
        flight[row.key] = std::isfinite(row.values[i]) ? Json(row.values[i]) : Json(nullptr);
    }
    report["sessions"].push_back(flight);
  }
  report["report"] = out.empty() ? Json(nullptr) : Json(out);
  return report.dump(2) + "\n";
}

/// A column for each flight: numbers to the right, under each other. UTF-8 in names may shift what follows.
std::string textReport(const std::vector<SessionSummary>& summaries, const std::vector<ComparisonRow>& rows) {
  std::string text;
  const auto add = [&text](int width, const std::string& cell) {
    const auto missing = static_cast<std::ptrdiff_t>(std::abs(width)) - static_cast<std::ptrdiff_t>(cell.size());
    const std::string room(static_cast<std::size_t>(std::max<std::ptrdiff_t>(1, missing)), ' ');
    text += width < 0 ? cell + room : room + cell;
  };
  for (std::size_t i = 0; i < summaries.size(); ++i)
    text += sessionLetter(i) + "  " + summaries[i].file + "\n";
  text += "\n";
  add(-kNameWidth, "");
  for (std::size_t i = 0; i < summaries.size(); ++i) add(kCellWidth, sessionLetter(i));
  text += "\n";
  for (const ComparisonRow& row : rows) {
    add(-kNameWidth, row.unit.empty() ? row.name : row.name + " [" + row.unit + "]");
    for (const auto& word : row.words) add(kCellWidth, word);
    for (const double value : row.values) {
      char number[40];
      std::snprintf(number, sizeof number, "%.*f", row.decimals, value);
      add(kCellWidth, std::isfinite(value) ? number : "-");
    }
    text += "\n";
  }
  return text;
}

int compare(const Arguments& arguments) {
  if (arguments.sessions.size() < 2)
    throw Error(ErrorKind::kInput, "one session cannot be compared", "SESSION", "give two or more");
  requireFigures(arguments);
  const std::vector<SessionSummary> summaries = readSessions(arguments.sessions);
  const std::vector<ComparisonRow> rows = compareSessions(summaries);
  writeFigures(summaries, arguments);
  const std::string report =
      arguments.json ? jsonReport(summaries, rows, arguments.out) : textReport(summaries, rows);
  if (std::fputs(report.c_str(), stdout) < 0 || std::fflush(stdout) != 0)
    throw Error(ErrorKind::kSystem, "the report cannot be written to standard output", {},
                "check the disk or the pipe");
  return 0;
}

}  // namespace

void addCompareCommand(CLI::App& app, int& exit_code) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand("compare", "Recorded sessions beside each other: one table, one report");
  command->add_option("SESSIONS", arguments->sessions, "Two or more sessions' MCAP files")->required();
  command->add_option("--out", arguments->out, "PDF file for the table and the plots over each other");
  command->add_option("--figures", arguments->figures,
                      "Folder for the plots, PNG and PDF; of two flights the paper's figures 6 to 11");
  command->add_flag("--json", arguments->json, "Print one JSON object");
  command->callback([arguments, &exit_code] { exit_code = compare(*arguments); });
}

}  // namespace helical
