#include <QApplication>
#include <QContextMenuEvent>
#include <QCursor>
#include <QFile>
#include <QImage>
#include <QMenu>
#include <QTemporaryDir>
#include <QTextStream>
#include <QWheelEvent>

#include "tests/ui/window_fixture.h"
#include "ui/latency_plot.h"
#include "ui/plot_deck.h"
#include "ui/time_plots.h"

namespace helical {
namespace {

class PlotsWindow : public WindowTest {
 protected:
  void fly() {
    open(false);
    ASSERT_NO_FATAL_FAILURE(takeOffByMouse());
    ASSERT_TRUE(eventually([this] { return window_->plots().history().end() > 200; }));
  }
  TimePlots& show(PlotDeck::Sheet sheet) {
    window_->plots().showSheet(sheet);
    return window_->plots().sheet(sheet);
  }
  /// What receives the mouse within a sheet.
  static QWidget* canvas(const TimePlots& plots) { return plots.childAt(plots.rect().center()); }
};

TEST_F(PlotsWindow, TheRasterHasABarForEachFeatureThatIsUsed) {
  open(false);
  engine_->hideCamera(cameraId(2), true);
  ASSERT_NO_FATAL_FAILURE(takeOffByMouse());
  ASSERT_TRUE(eventually([this] { return window_->plots().history().end() > 200; }));
  TimePlots& raster = show(PlotDeck::kFeatures);
  const int markers = snapshot().marker_count;
  for (int series = 0; series < 2 * markers; ++series)
    EXPECT_TRUE(eventually([&] { return raster.pointCount(0, series) > 50; })) << series;
  for (int series = 2 * markers; series < 3 * markers; ++series)
    EXPECT_EQ(raster.pointCount(0, series), 0) << "camera 3 is hidden";
}

TEST_F(PlotsWindow, DraggingScrollsBackWhileTheFlightGoesOnAndADoubleClickFollowsAgain) {
  ASSERT_NO_FATAL_FAILURE(fly());
  TimePlots& plots = show(PlotDeck::kFlight);
  TimeAxis& axis = window_->plots().axis();
  for (int i = 0; i < 60; ++i) axis.zoom(0.8, axis.end());  // to two seconds: there is room to scroll
  QWidget* on = canvas(plots);
  ASSERT_NE(on, nullptr);
  const QPoint from = on->rect().center();
  QTest::mousePress(on, Qt::LeftButton, {}, from);
  QTest::mouseMove(on, from + QPoint(60, 0));
  QTest::mouseMove(on, from + QPoint(90, 0));
  QTest::mouseRelease(on, Qt::LeftButton, {}, from + QPoint(90, 0));
  EXPECT_FALSE(axis.live());
  const double end = axis.end();
  const std::uint64_t tick = snapshot().tick;
  ASSERT_TRUE(eventually([&] { return snapshot().tick > tick + 60; }));
  EXPECT_EQ(axis.end(), end) << "held while ticks arrive";
  QTest::mouseDClick(on, Qt::LeftButton, {}, from);
  EXPECT_TRUE(axis.live());
  EXPECT_GT(axis.end(), end);
}

TEST_F(PlotsWindow, SpaceHoldsThePlotsStill) {
  ASSERT_NO_FATAL_FAILURE(fly());
  window_->activateWindow();
  ASSERT_TRUE(QTest::qWaitForWindowActive(window_.get(), kPatienceMs));
  press(Qt::Key_Space);
  EXPECT_TRUE(eventually([this] { return !window_->plots().axis().live(); }));
  press(Qt::Key_Space);
  EXPECT_TRUE(eventually([this] { return window_->plots().axis().live(); }));
}

TEST_F(PlotsWindow, ThePointerReadsTheTime) {
  ASSERT_NO_FATAL_FAILURE(fly());
  TimePlots& plots = show(PlotDeck::kFlight);
  EXPECT_FALSE(plots.hovered().has_value());
  QWidget* on = canvas(plots);
  QTest::mouseMove(on, QPoint(on->width() / 4, on->height() / 4));
  ASSERT_TRUE(eventually([&] { return plots.hovered().has_value(); }));
  EXPECT_GE(*plots.hovered(), window_->plots().axis().begin() - 1.0);
  EXPECT_LE(*plots.hovered(), window_->plots().axis().end());
}

TEST_F(PlotsWindow, TheLatencyHistogramIsSavedByARightClick) {
  ASSERT_NO_FATAL_FAILURE(fly());
  window_->plots().showSheet(PlotDeck::kLatency);
  LatencyPlot& plot = window_->plots().latency();
  ASSERT_TRUE(eventually([&] { return plot.histogram(0).count > 50; }));
  QContextMenuEvent click(QContextMenuEvent::Mouse, plot.rect().center(), plot.mapToGlobal(plot.rect().center()));
  QApplication::sendEvent(&plot, &click);
  auto* menu = plot.findChild<QMenu*>();
  ASSERT_NE(menu, nullptr);
  EXPECT_EQ(menu->actions().size(), 3);
  menu->close();
  QTemporaryDir folder;
  for (const char* suffix : {"png", "pdf", "csv"}) ASSERT_TRUE(plot.save(folder.filePath("latency.") + suffix));
  EXPECT_GT(QImage(folder.filePath("latency.png")).width(), plot.width());
  QFile pdf(folder.filePath("latency.pdf")), csv(folder.filePath("latency.csv"));
  ASSERT_TRUE(pdf.open(QIODevice::ReadOnly));
  EXPECT_TRUE(pdf.read(5) == "%PDF-");
  ASSERT_TRUE(csv.open(QIODevice::ReadOnly | QIODevice::Text));
  QTextStream lines(&csv);
  EXPECT_EQ(lines.readLine(), "from_ms,\"Camera 1 [frames]\",\"Camera 2 [frames]\",\"Camera 3 [frames]\"");
  int frames = 0;
  while (!lines.atEnd()) frames += lines.readLine().split(',').at(1).toInt();
  EXPECT_EQ(frames, plot.histogram(0).count);
  EXPECT_FALSE(plot.save(folder.filePath("missing/latency.csv")));
}

TEST_F(PlotsWindow, EverySheetIsSavedAsPicturePageAndTable) {
  ASSERT_NO_FATAL_FAILURE(fly());
  QTemporaryDir folder;
  for (const auto sheet : {PlotDeck::kFlight, PlotDeck::kLabels, PlotDeck::kFeatures, PlotDeck::kTracking}) {
    TimePlots& plots = show(sheet);
    const QString base = folder.filePath(plots.page().name);
    ASSERT_TRUE(plots.save(base + ".png"));
    EXPECT_GT(QImage(base + ".png").width(), 500);
    ASSERT_TRUE(plots.save(base + ".pdf"));
    QFile pdf(base + ".pdf");
    ASSERT_TRUE(pdf.open(QIODevice::ReadOnly));
    EXPECT_TRUE(pdf.read(5) == "%PDF-");
    ASSERT_TRUE(plots.save(base + ".csv"));
    QFile csv(base + ".csv");
    ASSERT_TRUE(csv.open(QIODevice::ReadOnly | QIODevice::Text));
    QTextStream lines(&csv);
    const QStringList head = lines.readLine().split(',');
    EXPECT_EQ(head.front(), "time_s");
    int rows = 0;
    while (!lines.atEnd()) {
      EXPECT_EQ(lines.readLine().count(','), head.size() - 1);
      ++rows;
    }
    EXPECT_GT(rows, 100);
    EXPECT_FALSE(plots.save(folder.filePath("nowhere/") + "x.csv"));
  }
}

}  // namespace
}  // namespace helical
