#include "ui/figures/session_report.h"

#include <QPageSize>
#include <QPainter>
#include <QPdfWriter>
#include <QSaveFile>
#include <QTextDocument>

#include "engine/base/error.h"
#include "ui/figures/comparison_figures.h"
#include "ui/figures/figure_drawing.h"
#include "ui/figures/session_figures.h"
#include "ui/figures/session_words.h"

namespace helical::figures {
namespace {

constexpr double kMillimetresPerInch = 25.4;
constexpr int kUnitsPerInch = 1200;
constexpr double kUnitsPerMillimetre = kUnitsPerInch / kMillimetresPerInch;
constexpr double kPointsPerMillimetre = 72.0 / kMillimetresPerInch;
const QSizeF kPage(210.0, 297.0);
constexpr double kBorder = 18.0;
constexpr double kFigureScale = 1.25;  // two figures of two panels fill a page
constexpr double kBetween = 10.0;
constexpr double kTitleHeight = 6.0;

[[noreturn]] void cannotWrite(const std::filesystem::path& path, const QString& reason) {
  throw Error(ErrorKind::kSystem, "the report cannot be written: " + reason.toStdString(), path.string(),
              "see that the folder may be written to and its disk has space, or name another folder");
}

/// Text is laid out in points; as many pages as it takes.
void drawText(QPainter& painter, QPdfWriter& writer, const QString& html) {
  QTextDocument text;
  text.setDefaultFont(QFont(QStringLiteral("DejaVu Sans"), 8));
  const QSizeF room = (kPage - QSizeF(2.0 * kBorder, 2.0 * kBorder)) * kPointsPerMillimetre;
  text.documentLayout();
  text.setPageSize(room);
  text.setHtml(html);
  for (int page = 0; page < text.pageCount(); ++page) {
    if (page > 0) writer.newPage();
    painter.save();
    painter.translate(kBorder, kBorder);
    painter.scale(1.0 / kPointsPerMillimetre, 1.0 / kPointsPerMillimetre);
    painter.translate(0.0, -page * room.height());
    text.drawContents(&painter, QRectF(QPointF(0.0, page * room.height()), room));
    painter.restore();
  }
}

void drawTitle(QPainter& painter, double top, const QString& title) {
  QFont font(QStringLiteral("DejaVu Sans"));
  font.setPixelSize(4);
  painter.setFont(font);
  painter.setPen(kInk);
  painter.drawText(QRectF(kBorder, top, kPage.width() - 2.0 * kBorder, kTitleHeight), Qt::AlignVCenter,
                   title);
}

void drawFigures(QPainter& painter, QPdfWriter& writer, const std::vector<Figure>& figures) {
  double top = kPage.height();  // nothing fits there: the first one begins a page
  for (const Figure& figure : figures) {
    const FigureLayout layout = layoutFigure(figure);
    const double scale =
        std::min(kFigureScale, (kPage.height() - 2.0 * kBorder - kTitleHeight) / layout.size.height());
    const double height = kTitleHeight + scale * layout.size.height();
    if (top + height > kPage.height() - kBorder) {
      writer.newPage();
      top = kBorder;
    }
    drawTitle(painter, top, figure.title);
    painter.save();
    painter.translate(kBorder, top + kTitleHeight);
    painter.scale(scale, scale);
    drawFigure(painter, figure, layout);
    painter.restore();
    top += height + kBetween;
  }
}

void writeReport(const std::filesystem::path& path, const QString& title, const QString& words,
                 const std::vector<Figure>& figures) {
  QSaveFile file(QString::fromStdString(path.string()));
  if (!file.open(QIODevice::WriteOnly)) cannotWrite(path, file.errorString());
  {
    QPdfWriter writer(&file);
    writer.setTitle(title);
    writer.setCreator(QStringLiteral("Helical"));
    writer.setResolution(kUnitsPerInch);
    writer.setPageSize(QPageSize(kPage, QPageSize::Millimeter, {}, QPageSize::ExactMatch));
    writer.setPageMargins(QMarginsF());
    QPainter painter;
    if (!painter.begin(&writer)) cannotWrite(path, file.errorString());
    painter.scale(kUnitsPerMillimetre, kUnitsPerMillimetre);
    drawText(painter, writer, words);
    drawFigures(painter, writer, figures);
  }
  if (!file.commit()) cannotWrite(path, file.errorString());
}

}  // namespace

std::filesystem::path writeSessionReport(const SessionSummary& session, const std::filesystem::path& folder) {
  const std::filesystem::path path = folder / "report.pdf";
  writeReport(path, QStringLiteral("Flight report"), sessionInWords(session), sessionFigures(session));
  return path;
}

std::filesystem::path writeComparisonReport(const std::vector<SessionSummary>& sessions,
                                            const std::filesystem::path& file) {
  writeReport(file, QStringLiteral("Comparison of flights"), comparisonInWords(sessions),
              comparisonFigures(sessions));
  return file;
}

}  // namespace helical::figures
