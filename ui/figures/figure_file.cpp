#include "ui/figures/figure_file.h"

#include <QImageWriter>
#include <QPageSize>
#include <QPainter>
#include <QPdfWriter>
#include <QSaveFile>
#include <cmath>

#include "engine/base/error.h"
#include "ui/figures/figure_drawing.h"

namespace helical::figures {
namespace {

constexpr double kMillimetresPerInch = 25.4;
constexpr double kPixelsPerMillimetre = 300.0 / kMillimetresPerInch;
constexpr int kPdfUnitsPerInch = 1200;

[[noreturn]] void cannotWrite(const std::filesystem::path& path, const QString& reason) {
  throw Error(ErrorKind::kSystem, "the figure cannot be written: " + reason.toStdString(), path.string(),
              "see that the folder may be written to and its disk has space, or name another folder");
}

/// Runs `write` on the new file, which takes its name only when it is whole.
template <typename Write>
std::filesystem::path writeFile(const std::filesystem::path& path, const Write& write) {
  QSaveFile file(QString::fromStdString(path.string()));
  if (!file.open(QIODevice::WriteOnly)) cannotWrite(path, file.errorString());
  write(file);
  if (!file.commit()) cannotWrite(path, file.errorString());
  return path;
}

void fillPng(QIODevice& file, const Figure& figure, const std::filesystem::path& path) {
  QImageWriter writer(&file, "png");
  writer.setText(QStringLiteral("Title"), figure.title);
  writer.setText(QStringLiteral("Software"), QStringLiteral("Helical"));
  if (!writer.write(paintFigure(figure))) cannotWrite(path, writer.errorString());
}

void fillPdf(QIODevice& file, const Figure& figure, const std::filesystem::path& path) {
  const FigureLayout layout = layoutFigure(figure);
  QPdfWriter writer(&file);
  writer.setTitle(figure.title);
  writer.setCreator(QStringLiteral("Helical"));
  writer.setResolution(kPdfUnitsPerInch);
  writer.setPageSize(QPageSize(layout.size, QPageSize::Millimeter, {}, QPageSize::ExactMatch));
  writer.setPageMargins(QMarginsF());
  QPainter painter;
  if (!painter.begin(&writer)) cannotWrite(path, file.errorString());
  const double scale = kPdfUnitsPerInch / kMillimetresPerInch;
  painter.scale(scale, scale);
  drawFigure(painter, figure, layout);
}

}  // namespace

QImage paintFigure(const Figure& figure) {
  const FigureLayout layout = layoutFigure(figure);
  const QSizeF pixels = layout.size * kPixelsPerMillimetre;
  QImage image(static_cast<int>(std::lround(pixels.width())), static_cast<int>(std::lround(pixels.height())),
               QImage::Format_RGB32);
  image.fill(Qt::white);
  const int pixels_per_metre = static_cast<int>(std::lround(1e3 * kPixelsPerMillimetre));
  image.setDotsPerMeterX(pixels_per_metre);
  image.setDotsPerMeterY(pixels_per_metre);
  QPainter painter(&image);
  painter.scale(kPixelsPerMillimetre, kPixelsPerMillimetre);
  drawFigure(painter, figure, layout);
  return image;
}

std::filesystem::path writePng(const Figure& figure, const std::filesystem::path& folder) {
  const std::filesystem::path png = folder / (figure.file_stem + ".png").toStdString();
  return writeFile(png, [&](QIODevice& file) { fillPng(file, figure, png); });
}

std::filesystem::path writePdf(const Figure& figure, const std::filesystem::path& folder) {
  const std::filesystem::path pdf = folder / (figure.file_stem + ".pdf").toStdString();
  return writeFile(pdf, [&](QIODevice& file) { fillPdf(file, figure, pdf); });
}

std::vector<std::filesystem::path> writeFigure(const Figure& figure, const std::filesystem::path& folder) {
  return {writePng(figure, folder), writePdf(figure, folder)};
}

}  // namespace helical::figures
