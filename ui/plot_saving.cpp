#include "ui/plot_saving.h"

#include <QCoreApplication>
#include <QFile>
#include <QMenu>
#include <QPainter>
#include <QPdfWriter>
#include <QPixmap>
#include <QTextStream>
#include <QWidget>
#include <algorithm>
#include <cmath>

#include "ui/open_dialog.h"

namespace helical {
namespace {

constexpr double kPictureScale = 2.0;

QString tr(const char* text) {
  return QCoreApplication::translate("PlotSaving", text);
}

void askAndSave(QWidget* plot, const QString& name, const QString& suffix, const PlotSaver& save) {
  const auto save_to = [plot, save](const QString& path) {
    if (!save(path))
      openNotice(plot, tr("Save the plots"), tr("%1 cannot be written. Choose another folder.").arg(path));
  };
  askWhereToSave(plot, tr("Save the plots"), QStringLiteral("helical-%1.%2").arg(name.toLower(), suffix),
                 QStringLiteral("*.%1").arg(suffix), save_to);
}

bool savePage(QWidget& widget, const QString& path) {
  QPdfWriter page(path);
  page.setPageSize(QPageSize(QSizeF(widget.size()) * 0.75, QPageSize::Point));  // 96 px to 72 points
  page.setPageMargins(QMarginsF());
  QPainter painter;
  if (!painter.begin(&page)) return false;
  const double scale = static_cast<double>(page.width()) / widget.width();
  painter.scale(scale, scale);
  widget.render(&painter);
  return painter.end();
}

bool savePicture(QWidget& widget, const QString& path) {
  if (path.endsWith(QStringLiteral(".pdf"), Qt::CaseInsensitive)) return savePage(widget, path);
  QPixmap picture(widget.size() * kPictureScale);
  picture.setDevicePixelRatio(kPictureScale);
  widget.render(&picture);
  return picture.save(path);
}

QString headOf(const std::vector<PlotLane>& lanes) {
  QString head = QStringLiteral("time_s");
  for (const PlotLane& lane : lanes)
    for (const PlotSeries& series : lane.series) {
      QString name = lane.title + QLatin1Char(' ') + (series.column_name.isEmpty() ? series.name : series.column_name);
      if (series.bit >= 0) name += QStringLiteral("row %1").arg(series.level);
      if (!lane.unit.isEmpty()) name += QStringLiteral(" [%1]").arg(lane.unit);
      head += QStringLiteral(",\"%1\"").arg(name.simplified());
    }
  return head;
}

}  // namespace

void offerToSave(QWidget* plot, const QPoint& position, const QString& name, const PlotSaver& save) {
  auto* menu = new QMenu(plot);
  menu->setAttribute(Qt::WA_DeleteOnClose);
  for (const char* suffix : {"png", "pdf", "csv"})
    menu->addAction(tr("Save as %1\u2026").arg(QString::fromLatin1(suffix).toUpper()), plot,
                    [plot, name, suffix, save] { askAndSave(plot, name, QString::fromLatin1(suffix), save); });
  menu->popup(position);
}

bool saveText(const QString& path, const QString& text) {
  QFile file(path);
  if (!file.open(QIODevice::WriteOnly | QIODevice::Text)) return false;
  QTextStream out(&file);
  out << text;
  out.flush();
  return file.error() == QFileDevice::NoError && out.status() == QTextStream::Ok;
}

bool savePlot(QWidget& plot, const QString& path, const std::function<QString()>& table) {
  if (path.endsWith(QStringLiteral(".csv"), Qt::CaseInsensitive)) return saveText(path, table());
  return savePicture(plot, path);
}

QString tableOf(const std::vector<PlotLane>& lanes, const TickHistory& history, std::int64_t begin,
                std::int64_t end) {
  QString text = headOf(lanes) + QLatin1Char('\n');
  QTextStream out(&text, QIODevice::Append);
  for (std::int64_t row = begin; row < end; ++row) {
    out << QString::number(history.time(row), 'f', 6);
    for (const PlotLane& lane : lanes)
      for (const PlotSeries& series : lane.series) {
        const double value = valueOf(series, history, row);
        out << ',';
        if (series.bit >= 0)
          out << (std::isfinite(value) ? 1 : 0);
        else if (std::isfinite(value))
          out << value;
      }
    out << '\n';
  }
  out.flush();
  return text;
}

}  // namespace helical
