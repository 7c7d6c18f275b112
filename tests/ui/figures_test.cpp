#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/ui/figures_flight.h"
#include "ui/figures/clipped_curve.h"
#include "ui/figures/figure_style.h"
#include "ui/figures/label_runs.h"
#include "ui/figures/paper_figures.h"
#include "ui/figures/plot_axes.h"

namespace helical::figures {
namespace {

const double kNaN = std::numeric_limits<double>::quiet_NaN();
const double kInfinity = std::numeric_limits<double>::infinity();

/// 10 mm to a unit both ways, top left corner of the frame at (20, 5).
PlotAxes squareAxes() {
  return {QRectF(20.0, 5.0, 100.0, 20.0), plotAxis("t", 0.0, 10.0, 5.0), plotAxis("v", -1.0, 1.0, 0.5)};
}

void expectAt(const QPointF& point, double x, double y) {
  EXPECT_NEAR(point.x(), x, 1e-9);
  EXPECT_NEAR(point.y(), y, 1e-9);
}

TEST(PlotAxes, PutDataOnThePage) {
  const PlotAxes axes = squareAxes();
  expectAt(axes.at({0.0, -1.0}), 20.0, 25.0);
  expectAt(axes.at({10.0, 1.0}), 120.0, 5.0);
  expectAt(axes.at({5.0, 0.5}), 70.0, 10.0);
  expectAt(axes.at({-1.0, 2.0}), 10.0, -5.0);
  EXPECT_TRUE(axes.contains({10.0, -1.0}));
  EXPECT_FALSE(axes.contains({10.1, 0.0}));
  EXPECT_FALSE(axes.contains({5.0, 1.1}));
}

TEST(PlotAxes, TicksAreThePapers) {
  const auto texts = [](const PlotAxis& axis) {
    QStringList list;
    for (const double tick : axis.ticks()) list << axis.tickText(tick);
    return list.join(' ').replace(QChar(0x2212), QChar('-')).toStdString();
  };
  EXPECT_EQ(texts(plotAxis("x", -0.8, 0.2, 0.2)), "-0.8 -0.6 -0.4 -0.2 0 0.2");
  EXPECT_EQ(texts(plotAxis("z", 0.0, 0.8, 0.1)), "0 0.1 0.2 0.3 0.4 0.5 0.6 0.7 0.8");
  EXPECT_EQ(texts(plotAxis("deg", -40.0, 40.0, 10.0)), "-40 -30 -20 -10 0 10 20 30 40");
  EXPECT_EQ(texts(PlotAxis{"label", -0.5, 12.0, 2.0, 0.0}), "0 2 4 6 8 10 12");
}

TEST(ClippedCurve, StaysWholeInside) {
  const ClippedCurve curve = clipCurve(squareAxes(), {{0.0, 0.0}, {5.0, 1.0}, {10.0, -1.0}});
  ASSERT_EQ(curve.pieces.size(), 1u);
  EXPECT_EQ(curve.pieces[0].size(), 3);
  EXPECT_TRUE(curve.exits.empty());
}

TEST(ClippedCurve, IsCutAtTheFrameAndMarkedThere) {
  // Up through the top at t = 3, back at t = 5; down through the bottom at t = 8.
  const ClippedCurve curve =
      clipCurve(squareAxes(), {{2.0, 0.0}, {4.0, 2.0}, {6.0, 0.0}, {7.0, 0.0}, {9.0, -2.0}, {9.5, -3.0}});
  ASSERT_EQ(curve.pieces.size(), 2u);
  expectAt(curve.pieces[0].last(), 50.0, 5.0);
  expectAt(curve.pieces[1].first(), 70.0, 5.0);
  expectAt(curve.pieces[1].last(), 100.0, 25.0);
  ASSERT_EQ(curve.exits.size(), 2u);
  EXPECT_EQ(curve.exits[0].edge, PlotEdge::kTop);
  expectAt(curve.exits[0].at, 50.0, 5.0);
  EXPECT_EQ(curve.exits[1].edge, PlotEdge::kBottom);
  expectAt(curve.exits[1].at, 100.0, 25.0);
}

TEST(ClippedCurve, CrossesWithoutAPointInside) {
  const ClippedCurve curve = clipCurve(squareAxes(), {{4.0, 3.0}, {6.0, -3.0}});
  ASSERT_EQ(curve.pieces.size(), 1u);
  expectAt(curve.pieces[0].first(), 20.0 + 10.0 * (4.0 + 2.0 / 3.0), 5.0);
  expectAt(curve.pieces[0].last(), 20.0 + 10.0 * (5.0 + 1.0 / 3.0), 25.0);
  ASSERT_EQ(curve.exits.size(), 2u);
  EXPECT_EQ(curve.exits[1].edge, PlotEdge::kBottom);
}

TEST(ClippedCurve, OneThatIsNeverInsideIsMarkedAllTheSame) {
  const ClippedCurve curve = clipCurve(squareAxes(), {{1.0, -5.0}, {2.0, -6.0}});
  EXPECT_TRUE(curve.pieces.empty());
  ASSERT_EQ(curve.exits.size(), 1u);
  EXPECT_EQ(curve.exits[0].edge, PlotEdge::kBottom);
  expectAt(curve.exits[0].at, 30.0, 25.0);
}

TEST(ClippedCurve, TimeBeyondItsAxisIsMarkedAtTheSide) {
  const ClippedCurve curve = clipCurve(squareAxes(), {{9.0, 0.0}, {11.0, 0.0}});
  ASSERT_EQ(curve.exits.size(), 1u);
  EXPECT_EQ(curve.exits[0].edge, PlotEdge::kRight);
  expectAt(curve.exits[0].at, 120.0, 15.0);
}

TEST(ClippedCurve, BreaksAtWhatIsNotANumber) {
  const ClippedCurve curve =
      clipCurve(squareAxes(), {{1.0, 0.0}, {2.0, 0.0}, {3.0, kNaN}, {4.0, 0.0}, {5.0, 0.0}});
  ASSERT_EQ(curve.pieces.size(), 2u);
  expectAt(curve.pieces[0].last(), 40.0, 15.0);
  expectAt(curve.pieces[1].first(), 60.0, 15.0);
  EXPECT_TRUE(curve.exits.empty());
}

TEST(ClippedCurve, InfinityIsBeyondTheAxis) {
  const ClippedCurve curve = clipCurve(squareAxes(), {{1.0, 0.0}, {2.0, kInfinity}, {3.0, -1e300}});
  ASSERT_FALSE(curve.exits.empty());
  EXPECT_EQ(curve.exits[0].edge, PlotEdge::kTop);
  for (const QPolygonF& piece : curve.pieces) {
    for (const QPointF& point : piece) EXPECT_TRUE(std::isfinite(point.x()) && std::isfinite(point.y()));
  }
}

TEST(ClippedCurve, LessThanALineBeyondIsOnTheFrame) {
  const double hair = 0.9 * squareAxes().y().slack();
  const ClippedCurve curve = clipCurve(squareAxes(), {{1.0, 0.0}, {2.0, -1.0 - hair}, {3.0, -1.0 - hair}});
  EXPECT_TRUE(curve.exits.empty());
  ASSERT_EQ(curve.pieces.size(), 1u);
  expectAt(curve.pieces[0].last(), 50.0, 25.0);
}

TEST(ClippedCurve, TheEndsOfTheAxesAreInsideWhateverTheRoundingOfThePage) {
  for (int i = 0; i < 200; ++i) {
    const PlotAxes axes(QRectF(0.1 * i, 0.3 * i, 66.6 + 0.7 * i, 36.1), plotAxis("t", 0.1, 0.7, 0.1),
                        plotAxis("v", -0.7, 0.3, 0.1));
    const ClippedCurve curve = clipCurve(axes, {{0.1, 0.3}, {0.7, 0.3}, {0.7, -0.7}, {0.1, -0.7}});
    EXPECT_TRUE(curve.exits.empty());
    ASSERT_EQ(curve.pieces.size(), 1u);
    EXPECT_EQ(curve.pieces[0].size(), 4);
  }
}

TEST(ClippedCurve, MarksDoNotPileUp) {
  std::vector<QPointF> points;
  for (int i = 0; i < 1000; ++i) points.emplace_back(0.01 * i, i % 2 ? 1.5 : 0.5);
  const auto exits = clipCurve(squareAxes(), points).exits;
  EXPECT_GT(exits.size(), 10u);
  for (std::size_t i = 1; i < exits.size(); ++i)
    EXPECT_GE(exits[i].at.x() - exits[i - 1].at.x(), kExitMarkWidth);
}

FlightTrace smallTrace() {
  FlightTrace trace;
  trace.camera_count = 2;
  trace.marker_count = 3;
  for (int i = 0; i < 5; ++i) {
    TraceSample sample;
    sample.time_s = 0.5 * i;
    trace.samples.push_back(sample);
  }
  return trace;
}

TEST(LabelRuns, MergeConsecutiveTicks) {
  FlightTrace trace = smallTrace();
  for (const std::size_t i : {0u, 1u, 3u, 4u}) trace.samples[i].selected[1] = 0b100;
  trace.samples[2].selected[0] = 0b001;
  const auto runs = labelRuns(trace);
  ASSERT_EQ(runs.size(), 3u);
  EXPECT_EQ(runs[0].label, 0);
  EXPECT_DOUBLE_EQ(runs[0].from_s, 1.0);
  EXPECT_DOUBLE_EQ(runs[0].to_s, 1.5);
  EXPECT_EQ(runs[1].label, 5) << "markers (i - 1) + j - 1 with i = 2, j = 3";
  EXPECT_DOUBLE_EQ(runs[1].from_s, 0.0);
  EXPECT_DOUBLE_EQ(runs[1].to_s, 1.0);
  EXPECT_DOUBLE_EQ(runs[2].from_s, 1.5);
  EXPECT_DOUBLE_EQ(runs[2].to_s, 2.5) << "the last tick lasts as long as the one before";
}

TEST(LabelRuns, HaveThePapersLabels) {
  FlightTrace trace = smallTrace();
  trace.camera_count = 3;
  trace.marker_count = 4;
  for (std::size_t camera = 0; camera < 3; ++camera) trace.samples[0].selected[camera] = 0b1111;
  const auto runs = labelRuns(trace);
  ASSERT_EQ(runs.size(), 12u);
  for (int i = 0; i < 12; ++i) EXPECT_EQ(runs[static_cast<std::size_t>(i)].label, i);
}

TEST(LabelRuns, OfNothingAreNone) {
  FlightTrace trace = smallTrace();
  EXPECT_TRUE(labelRuns(trace).empty());
  trace.samples.clear();
  EXPECT_TRUE(labelRuns(trace).empty());
}

TEST(PaperFigures, HaveThePapersAxes) {
  const auto figures = paperFigures(crashedFlight(), landedFlight());
  ASSERT_EQ(figures.size(), 6u);
  const struct {
    const char* stem;
    std::vector<const char*> titles;
    double low, high;
  } expected[] = {{"fig06", {"x [m]", "y [m]"}, -0.8, 0.2},
                  {"fig07", {"z [m]", "\u03b8 [rad]"}, 0.0, 0.8},
                  {"fig08", {"label of the image features"}, -0.5, 12.0},
                  {"fig09", {"error of position [m]"}, -0.8, 0.8},
                  {"fig10", {"error of orientation [\u00b0]"}, -40.0, 40.0},
                  {"fig11", {"label of the image features"}, -0.5, 12.0}};
  for (std::size_t i = 0; i < figures.size(); ++i) {
    SCOPED_TRACE(expected[i].stem);
    EXPECT_EQ(figures[i].file_stem, expected[i].stem);
    ASSERT_EQ(figures[i].panels.size(), expected[i].titles.size());
    EXPECT_DOUBLE_EQ(figures[i].panels[0].y.low, expected[i].low);
    EXPECT_DOUBLE_EQ(figures[i].panels[0].y.high, expected[i].high);
    for (std::size_t p = 0; p < figures[i].panels.size(); ++p) {
      const Panel& panel = figures[i].panels[p];
      EXPECT_EQ(panel.y.title, QString::fromUtf8(expected[i].titles[p]));
      EXPECT_EQ(panel.x.title, "time [s]");
      EXPECT_DOUBLE_EQ(panel.x.high, 25.0);
    }
  }
  EXPECT_DOUBLE_EQ(figures[1].panels[1].y.low, -0.4);
  EXPECT_DOUBLE_EQ(figures[1].panels[1].y.high, 0.4);
}

TEST(PaperFigures, SayWhatHappenedAndOnlyThat) {
  const auto figures = paperFigures(crashedFlight(), landedFlight());
  const Panel& a = figures[2].panels[0];
  const Panel& b = figures[5].panels[0];
  ASSERT_EQ(a.notes.size(), 1u);
  EXPECT_EQ(a.notes[0].text, "the helicopter crashed");
  EXPECT_DOUBLE_EQ(a.notes[0].at_s, 16.5);
  EXPECT_TRUE(b.notes.empty());
  ASSERT_EQ(b.spans.size(), 1u);
  EXPECT_EQ(b.spans[0].text, "camera 2 covered");
  EXPECT_DOUBLE_EQ(b.spans[0].from_s, 13.0);
  EXPECT_DOUBLE_EQ(b.spans[0].to_s, 25.0);
  ASSERT_EQ(figures[0].panels[0].spans.size(), 1u) << "one for both flights";
  EXPECT_DOUBLE_EQ(figures[0].panels[0].spans[0].to_s, 25.0);

  FlightTrace crashed_too = landedFlight();
  crashed_too.crashed = true;
  crashed_too.crashed_at_s = 20.0;
  const Panel both = paperFigures(crashedFlight(), crashed_too)[0].panels[0];
  ASSERT_EQ(both.notes.size(), 2u);
  EXPECT_EQ(both.notes[0].text, "experiment B crashed") << "the latest on top";
  EXPECT_EQ(both.notes[1].text, "experiment A crashed");

  const auto both_landed = paperFigures(landedFlight(), landedFlight());
  for (const Figure& figure : both_landed) {
    for (const Panel& panel : figure.panels) EXPECT_TRUE(panel.notes.empty());
  }
}

TEST(PaperFigures, ExplainTheMarkOfWhatIsBeyondTheAxisWhereThereIsOne) {
  const auto explained = [](const Figure& figure) {
    for (const auto& row : figure.legend) {
      for (const LegendEntry& entry : row)
        if (entry.key == LegendKeyKind::kBeyondAxis) return true;
    }
    return false;
  };
  EXPECT_TRUE(explained(paperFigures(crashedFlight(), landedFlight())[0]));
  for (const Figure& figure : paperFigures(landedFlight(), landedFlight()))
    EXPECT_FALSE(explained(figure)) << figure.file_stem.toStdString();

  FlightTrace late = landedFlight();
  for (TraceSample& sample : late.samples) sample.time_s *= 1.2;
  for (const Figure& figure : paperFigures(late, late))
    EXPECT_TRUE(explained(figure)) << figure.file_stem.toStdString();
}

TEST(PaperFigures, ServeAnyNumberOfCamerasAndMarkers) {
  for (const auto& [cameras, markers, step] :
       {std::tuple{1, 1, 1.0}, {2, 4, 1.0}, {4, 4, 2.0}, {5, 9, 10.0}, {16, 16, 50.0}}) {
    FlightTrace trace = landedFlight();
    trace.camera_count = cameras;
    trace.marker_count = markers;
    for (TraceSample& sample : trace.samples)
      sample.selected[static_cast<std::size_t>(cameras - 1)] =
          static_cast<std::uint16_t>(1u << (markers - 1));
    const Panel panel = paperFigures(trace, trace)[5].panels[0];
    EXPECT_DOUBLE_EQ(panel.y.high, cameras * markers);
    EXPECT_DOUBLE_EQ(panel.y.step, step);
    EXPECT_EQ(panel.raster.runs.back().label, cameras * markers - 1);
    ASSERT_EQ(panel.braces.size(), static_cast<std::size_t>(cameras));
    EXPECT_EQ(panel.braces.back().text, QString("camera %1").arg(cameras));
  }
}

TEST(PaperFigures, RasterIsRunsNotTicks) {
  const FlightTrace trace = landedFlight();
  EXPECT_LT(labelRuns(trace).size(), trace.samples.size());
}

TEST(PaperFigures, NoLineIsDrawnFromPiToMinusPi) {
  FlightTrace spinning = landedFlight();
  for (TraceSample& sample : spinning.samples) sample.yaw = std::remainder(sample.time_s, 2.0 * M_PI);
  const auto figures = paperFigures(spinning, spinning);
  int breaks = 0;
  for (const QPointF& point : figures[1].panels[1].curves.back().points) breaks += std::isnan(point.y());
  EXPECT_EQ(breaks, 4) << "25 s at 1 rad/s";
}

TEST(PaperFigures, BothReferencesAreShownWhereTheyDiffer) {
  const FlightTrace landed = landedFlight();
  EXPECT_EQ(paperFigures(crashedFlight(), landed)[0].panels[0].curves.size(), 3u);
  FlightTrace other = landed;
  other.samples[300].reference.x() += 0.1;
  EXPECT_EQ(paperFigures(other, landed)[0].panels[0].curves.size(), 4u);
}

}  // namespace
}  // namespace helical::figures
