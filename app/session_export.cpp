#include "app/session_export.h"

#include "engine/base/error.h"
#include "engine/session/csv_export.h"
#include "engine/session/video_export.h"
#ifdef HELICAL_HAS_WINDOW
#include "engine/session/session_summary.h"
#include "ui/figures/figure_file.h"
#include "ui/figures/session_figures.h"
#include "ui/figures/session_report.h"
#endif

namespace helical {
namespace {

/// Shares the way from 0 to 1 among the steps.
class Steps {
 public:
  Steps(int count, const StepProgress& progress) : count_(count), progress_(progress) {}
  ExportProgress next(const std::string& name) {
    const int step = at_++;
    return [this, step, name](double done) { progress_((step + done) / count_, name); };
  }

 private:
  int count_, at_ = 0;
  const StepProgress& progress_;
};

void append(SessionExport& result, const std::vector<std::filesystem::path>& more) {
  result.files.insert(result.files.end(), more.begin(), more.end());
}

void addTables(const ExportOrder& order, McapReader& session, const ExportProgress& progress,
               SessionExport& result) {
  const CsvExport tables = exportCsv(session, order.folder, {order.topics, order.span}, progress);
  append(result, tables.files);
  if (tables.reading.damaged_chunks > 0)
    result.warnings.push_back(order.session.string() + ": " + std::to_string(tables.reading.damaged_chunks) +
                              " damaged chunks are left out");
}

#ifdef HELICAL_HAS_WINDOW
/// Of each figure what was asked for; the report holds all of them.
void addFigures(const ExportOrder& order, McapReader& session, const ExportProgress& progress,
                SessionExport& result) {
  const SessionSummary summary =
      summarize(session, [&](double done) { progress(0.5 * done); }, order.span);
  std::filesystem::create_directories(order.folder);
  const auto all = figures::sessionFigures(summary);
  for (std::size_t i = 0; i < all.size(); ++i) {
    progress(0.5 + 0.5 * static_cast<double>(i) / static_cast<double>(all.size()));
    if (order.png) result.files.push_back(figures::writePng(all[i], order.folder));
    if (order.pdf) result.files.push_back(figures::writePdf(all[i], order.folder));
  }
  if (order.pdf) result.files.push_back(figures::writeSessionReport(summary, order.folder));
}
#endif

void addFilms(const ExportOrder& order, const ExportProgress& progress, SessionExport& result) {
  try {
    const VideoExport films = exportVideo(order.session, order.folder, progress, order.span);
    append(result, films.files);
    for (const auto& label : films.without_images)
      result.warnings.push_back("no film of camera " + label + ": the session holds no images of it");
  } catch (const Error& error) {
    // There is a film of the scene at least.
    if (!order.scene || error.kind() != ErrorKind::kInput) throw;
    result.warnings.emplace_back(error.what());
  }
}

}  // namespace

SessionExport exportSession(const ExportOrder& order, const StepProgress& progress) {
  SessionExport result;
  McapReader session(order.session);
  const bool figures = order.png || order.pdf;
  Steps steps(int{order.tables} + int{figures} + int{order.films}, progress);
  if (order.tables) addTables(order, session, steps.next("Tables"), result);
#ifdef HELICAL_HAS_WINDOW
  if (figures) addFigures(order, session, steps.next("Figures"), result);
#endif
  if (order.films) addFilms(order, steps.next("Films"), result);
  if (!session.complete())
    result.warnings.push_back(order.session.string() + " was cut off: `helical recover` mends it");
  return result;
}

}  // namespace helical
