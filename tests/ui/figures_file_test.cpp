#include <gtest/gtest.h>
#include <stdlib.h>
#include <unistd.h>

#include <QFile>
#include <QGuiApplication>
#include <QImage>
#include <clocale>
#include <filesystem>

#include "engine/base/error.h"
#include "tests/ui/figures_flight.h"
#include "ui/figures/figure_file.h"
#include "ui/figures/figure_layout.h"
#include "ui/figures/figure_text.h"
#include "ui/figures/offscreen_application.h"
#include "ui/figures/paper_figures.h"

namespace helical::figures {
namespace {

constexpr double kPixelsPerMillimetre = 300.0 / 25.4;

/// As on a server: no display, and a platform asked for that would want one.
class FiguresWithoutDisplay : public testing::Test {
 protected:
  void SetUp() override {
    qunsetenv("DISPLAY");
    qunsetenv("WAYLAND_DISPLAY");
    qputenv("QT_QPA_PLATFORM", "xcb");
  }
};

class PaintedFigures : public FiguresWithoutDisplay {
 protected:
  void SetUp() override {
    FiguresWithoutDisplay::SetUp();
    application_ = std::make_unique<OffscreenApplication>();
  }

 private:
  std::unique_ptr<OffscreenApplication> application_;
};

/// Where something of `color` is within half a millimetre of a point of the page; drawing smooths edges.
bool hasColor(const QImage& image, const QPointF& page, const QColor& color) {
  constexpr int kReach = 6;
  const QPoint middle = (page * kPixelsPerMillimetre).toPoint();
  for (int y = middle.y() - kReach; y <= middle.y() + kReach; ++y) {
    for (int x = middle.x() - kReach; x <= middle.x() + kReach; ++x) {
      if (!image.valid(x, y)) continue;
      const QColor seen = image.pixelColor(x, y);
      if (std::abs(seen.red() - color.red()) + std::abs(seen.green() - color.green()) +
              std::abs(seen.blue() - color.blue()) <
          40)
        return true;
    }
  }
  return false;
}

/// Share of pixels that are not white within a rectangle of the page.
double inkShare(const QImage& image, const QRectF& page) {
  const QRect area =
      QRectF(page.topLeft() * kPixelsPerMillimetre, page.size() * kPixelsPerMillimetre).toRect();
  int inked = 0;
  for (int y = area.top(); y <= area.bottom(); ++y) {
    for (int x = area.left(); x <= area.right(); ++x) inked += image.pixelColor(x, y).lightness() < 128;
  }
  return static_cast<double>(inked) / (area.width() * area.height());
}

TEST_F(PaintedFigures, AnApplicationThatIsThereServesAndStays) {
  const QCoreApplication* const outer = QCoreApplication::instance();
  { const OffscreenApplication inner; }
  EXPECT_EQ(QCoreApplication::instance(), outer);
}

TEST_F(PaintedFigures, CurvesAreWhereTheDataSay) {
  FlightTrace a = landedFlight();
  FlightTrace b = landedFlight();
  for (std::size_t i = 0; i < a.samples.size(); ++i) {
    const double time = a.samples[i].time_s;
    a.samples[i].position.x() = -0.02 * time;
    b.samples[i].position.x() = -0.3 - 0.016 * time;
  }
  const Figure figure = paperFigures(a, b)[0];
  const PlotAxes axes = layoutFigure(figure).panels[0].axes;
  const QImage image = paintFigure(figure);
  for (const double time : {3.3, 7.1, 12.0, 18.4, 23.7}) {
    EXPECT_TRUE(hasColor(image, axes.at({time, -0.02 * time}), kExperimentA)) << time;
    EXPECT_TRUE(hasColor(image, axes.at({time, -0.3 - 0.016 * time}), kExperimentB)) << time;
    EXPECT_FALSE(hasColor(image, axes.at({time, -0.02 * time + 0.05}), kExperimentA)) << time;
    EXPECT_FALSE(hasColor(image, axes.at({time, -0.02 * time}), kExperimentB)) << time;
  }
}

TEST_F(PaintedFigures, WhatLeavesTheAxisIsMarkedOnTheFrame) {
  FlightTrace a = landedFlight();
  for (TraceSample& sample : a.samples) sample.position.x() = 0.1 * (sample.time_s - 10.0);
  const Figure figure = paperFigures(a, landedFlight())[0];
  const PlotAxes axes = layoutFigure(figure).panels[0].axes;
  const QImage image = paintFigure(figure);
  // Wider than the curve itself, whose slope is gentle: 1.2 mm below the frame the mark spans 1.2 mm.
  const QPointF tip = axes.at({12.0, 0.2});
  EXPECT_TRUE(hasColor(image, tip + QPointF(0.5, 1.2), kExperimentA));
  EXPECT_FALSE(hasColor(image, axes.at({14.0, 0.2}) + QPointF(0.0, 1.2), kExperimentA));
  EXPECT_FALSE(hasColor(image, axes.at({14.0, 0.2}) - QPointF(0.0, 2.0), kExperimentA)) << "clipped";
}

TEST_F(PaintedFigures, BarsOfTheRasterAreInTheirRows) {
  FlightTrace trace = landedFlight();
  trace.covered_camera = -1;
  for (TraceSample& sample : trace.samples) {
    sample.selected = {};
    if (sample.time_s >= 5.0 && sample.time_s < 10.0) sample.selected[0] = 0b0001;
    if (sample.time_s >= 12.0 && sample.time_s < 20.0) sample.selected[2] = 0b0100;
  }
  const Figure figure = paperFigures(trace, trace)[2];
  const PlotAxes axes = layoutFigure(figure).panels[0].axes;
  const QImage image = paintFigure(figure);
  EXPECT_TRUE(hasColor(image, axes.at({7.0, 0.0}), kExperimentA));
  EXPECT_TRUE(hasColor(image, axes.at({15.0, 10.0}), kExperimentA));
  EXPECT_FALSE(hasColor(image, axes.at({11.0, 0.0}), kExperimentA));
  EXPECT_FALSE(hasColor(image, axes.at({15.0, 9.0}), kExperimentA));
}

TEST_F(PaintedFigures, CoveredTimeIsShaded) {
  const FlightTrace trace = landedFlight();
  const Figure figure = paperFigures(trace, trace)[0];
  const PlotAxes axes = layoutFigure(figure).panels[0].axes;
  const QImage image = paintFigure(figure);
  EXPECT_TRUE(hasColor(image, axes.at({18.0, -0.6}), kCoveredShade));
  EXPECT_FALSE(hasColor(image, axes.at({10.0, -0.6}), kCoveredShade));
}

TEST_F(PaintedFigures, WordsAreWritten) {
  const Figure figure = paperFigures(crashedFlight(), landedFlight())[0];
  const FigureLayout layout = layoutFigure(figure);
  const QImage image = paintFigure(figure);
  EXPECT_GT(textWidth("experiment A"), 1.5 * textWidth("exper")) << "a font with widths of its own";
  for (std::size_t row = 0; row < layout.legend.size(); ++row) {
    for (std::size_t i = 0; i < layout.legend[row].size(); ++i) {
      const LegendEntry& entry = figure.legend[row][i];
      const double words = textWidth(entry.text);
      const QPointF place = layout.legend[row][i];
      const QRectF box(place.x() + legendEntryWidth(entry) - words, place.y() - 0.5 * kFontSize, words,
                       kFontSize);
      EXPECT_GT(inkShare(image, box), 0.08) << entry.text.toStdString();
      EXPECT_LT(inkShare(image, box), 0.5) << entry.text.toStdString();
    }
  }
}

TEST_F(PaintedFigures, NothingIsPlacedOutsideThePageOrOverDataWhateverTheNames) {
  FlightTrace a = crashedFlight();
  FlightTrace b = landedFlight();
  a.name = "experiment A with a name that is longer than most";
  b.name = "experiment B with a name that is longer than most";
  for (const Figure& figure : paperFigures(a, b)) {
    const FigureLayout layout = layoutFigure(figure);
    double above = 0.0;
    for (std::size_t row = 0; row < layout.legend.size(); ++row) {
      for (std::size_t i = 0; i < layout.legend[row].size(); ++i) {
        const QPointF place = layout.legend[row][i];
        EXPECT_LE(place.x() + legendEntryWidth(figure.legend[row][i]), kFigureWidth);
        above = std::max(above, place.y() + 0.5 * kRowHeight);
      }
    }
    for (const PanelLayout& panel : layout.panels) {
      EXPECT_GE(panel.spans_top, above);
      EXPECT_GE(panel.notes_top, panel.spans_top);
      EXPECT_GE(panel.axes.area().top(), panel.notes_top);
      EXPECT_GT(panel.axes.area().width(), 0.6 * kFigureWidth);
      above = panel.axes.area().bottom();
    }
    EXPECT_GT(layout.size.height(), above);
  }
}

/// A folder of its own that goes with the test.
class FigureFiles : public FiguresWithoutDisplay {
 protected:
  void SetUp() override {
    FiguresWithoutDisplay::SetUp();
    std::string name = (std::filesystem::temp_directory_path() / "helical_figures_XXXXXX").string();
    ASSERT_NE(mkdtemp(name.data()), nullptr);
    folder_ = name;
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path folder_;
};

/// All compressed streams of a PDF, unpacked.
QByteArray pdfContent(const QByteArray& pdf) {
  QByteArray content;
  for (qsizetype at = pdf.indexOf("stream\n"); at >= 0; at = pdf.indexOf("stream\n", at + 7)) {
    if (at >= 3 && pdf.mid(at - 3, 3) == "end") continue;
    if (pdf.at(at + 7) != 'x') continue;  // not compressed
    const qsizetype end = pdf.indexOf("endstream", at);
    // qUncompress wants the expected size in front; it grows from there.
    content += qUncompress(QByteArray("\0\1\0\0", 4) + pdf.mid(at + 7, end - at - 7));
  }
  return content;
}

TEST_F(FigureFiles, AreSixPngsAndSixPdfs) {
  const std::filesystem::path folder = folder_ / "made" / "on the way";
  const auto files = writePaperFigures(crashedFlight(), landedFlight(), folder);
  ASSERT_EQ(files.size(), 12u);
  for (int number = 6; number <= 11; ++number) {
    const QString stem =
        QString::fromStdString((folder / "fig").string()) + QString("%1").arg(number, 2, 10, QChar('0'));
    const QImage image(stem + ".png");
    ASSERT_FALSE(image.isNull()) << stem.toStdString();
    EXPECT_EQ(image.width(), 1004);
    EXPECT_EQ(image.text("Software"), "Helical");
    QFile file(stem + ".pdf");
    ASSERT_TRUE(file.open(QIODevice::ReadOnly));
    const QByteArray pdf = file.readAll();
    EXPECT_TRUE(pdf.startsWith("%PDF-"));
    EXPECT_FALSE(pdf.contains("/Subtype /Image")) << "lines and letters, no picture";
    EXPECT_TRUE(pdf.contains("/FontFile2"));
    const QByteArray content = pdfContent(pdf);
    EXPECT_GT(content.count(" l\n"), 20) << "lines";
    EXPECT_GT(content.count("Tj"), 5) << "letters";
    EXPECT_LT(pdf.size(), 300'000);
  }
  EXPECT_EQ(QCoreApplication::instance(), nullptr) << "gone with the call";
}

TEST_F(FigureFiles, ComeAgainAndOverwriteTheOldOnes) {
  writePaperFigures(crashedFlight(), landedFlight(), folder_);
  const QImage first(QString::fromStdString((folder_ / "fig06.png").string()));
  writePaperFigures(crashedFlight(), landedFlight(), folder_);
  EXPECT_EQ(first, QImage(QString::fromStdString((folder_ / "fig06.png").string())));
  writePaperFigures(landedFlight(), landedFlight(), folder_);
  EXPECT_NE(first, QImage(QString::fromStdString((folder_ / "fig06.png").string())));
}

TEST_F(FigureFiles, LeaveTheLocaleAlone) {
  const std::string before = std::setlocale(LC_ALL, nullptr);
  writePaperFigures(crashedFlight(), landedFlight(), folder_);
  EXPECT_EQ(std::setlocale(LC_ALL, nullptr), before);
}

TEST_F(FigureFiles, AFolderThatCannotBeMadeIsNamed) {
  QFile file(QString::fromStdString((folder_ / "file").string()));
  ASSERT_TRUE(file.open(QIODevice::WriteOnly));
  const std::filesystem::path folder = folder_ / "file" / "figures";
  try {
    writePaperFigures(crashedFlight(), landedFlight(), folder);
    FAIL() << "a file is no folder";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kSystem);
    EXPECT_EQ(error.where(), folder.string());
    EXPECT_FALSE(error.cure().empty());
  }
}

TEST_F(FigureFiles, AFileThatCannotBeWrittenIsNamed) {
  // Root may write anywhere, but nobody writes over a folder.
  const std::filesystem::path in_the_way = folder_ / "fig08.pdf";
  std::filesystem::create_directory(in_the_way);
  try {
    writePaperFigures(crashedFlight(), landedFlight(), folder_);
    FAIL() << "a folder stands where the file should";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kSystem);
    EXPECT_EQ(error.where(), in_the_way.string());
    EXPECT_FALSE(error.cure().empty());
  }
}

TEST_F(FigureFiles, FlightsWithoutSamplesGiveEmptyPlots) {
  FlightTrace nothing = landedFlight();
  nothing.samples.clear();
  EXPECT_EQ(writePaperFigures(nothing, nothing, folder_).size(), 12u);
}

TEST_F(FiguresWithoutDisplay, PicturesForPeopleToLookAt) {
  const std::filesystem::path pictures = HELICAL_PICTURE_DIR;
  for (const auto& file : writePaperFigures(crashedFlight(), landedFlight(), pictures / "figures"))
    EXPECT_GT(std::filesystem::file_size(file), 5000u) << file;
}

}  // namespace
}  // namespace helical::figures
