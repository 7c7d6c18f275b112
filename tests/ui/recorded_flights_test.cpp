#include <gtest/gtest.h>
#include <qcustomplot.h>

#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QLineEdit>
#include <QListWidget>
#include <QProgressBar>
#include <QPushButton>
#include <QSignalSpy>
#include <QTableWidget>
#include <QTest>
#include <filesystem>

#include "engine/pipeline/lock_step.h"
#include "engine/session/csv_export.h"
#include "engine/session/recorder.h"
#include "tests/session/session_fixture.h"
#include "ui/comparison_window.h"
#include "ui/export_dialog.h"
#include "ui/scene_film.h"

namespace helical {
namespace {

constexpr int kPatienceMs = 120'000;  // for anything that must happen; no measure of speed

/// Takes off and hovers; `delay` ticks later than at once.
SessionSummary record(const std::filesystem::path& file, std::uint64_t seed, int delay, int ticks) {
  const SessionSettings settings = test::hoverSettings(seed);
  {
    Recorder recorder(file, settings, Recorder::WhenFull::kWait);
    LockStep flight(settings.rig, settings.plan, &recorder);
    for (int i = 0; i < ticks; ++i) {
      OperatorCommands commands;
      commands.arm = commands.take_off = i == 120 + delay;
      flight.tick(commands);
    }
  }
  McapReader session(file);
  return summarize(session, [](double) {});
}

void savePicture(QWidget& window, const char* name) {
  std::filesystem::create_directories(HELICAL_PICTURE_DIR);
  window.grab().save(QStringLiteral(HELICAL_PICTURE_DIR "/%1.png").arg(QLatin1String(name)));
}

TEST(RecordedFlights, LieOverEachOtherFromTakeOffOn) {
  const test::TemporaryFolder folder;
  ComparisonWindow window({record(folder / "early.mcap", 5, 0, 600), record(folder / "late.mcap", 5, 90, 600)});
  window.show();
  ASSERT_TRUE(QTest::qWaitForWindowExposed(&window));
  ASSERT_GE(window.choice()->count(), 4);
  ASSERT_EQ(window.plot()->graphCount(), 6);  // x and y, each with a reference and two flights
  const auto firstAfterZero = [&](int graph) {
    const auto points = window.plot()->graph(graph)->data();
    for (auto point = points->constBegin(); point != points->constEnd(); ++point)
      if (point->key > 0.0) return point->key;
    return -1.0;
  };
  for (const int graph : {1, 2}) EXPECT_NEAR(firstAfterZero(graph), 0.0, 0.05);
  const double begins_a = window.plot()->graph(1)->data()->constBegin()->key;
  const double begins_b = window.plot()->graph(2)->data()->constBegin()->key;
  EXPECT_NEAR(begins_a - begins_b, 1.5, 0.1) << "the later one was recorded for longer before";
  QTableWidget& table = *window.table();
  EXPECT_EQ(table.columnCount(), 3);
  EXPECT_GT(table.rowCount(), 20);
  EXPECT_EQ(table.horizontalHeaderItem(1)->text(), QStringLiteral("A: early"));
  savePicture(window, "comparison");
  window.choice()->setCurrentIndex(1);
  EXPECT_EQ(window.plot()->graphCount(), 6);
}

TEST(RecordedFlights, AreExportedAsTheDialogSays) {
  ExportContents contents;
  contents.session = "/tmp/flight.mcap";
  contents.topics = {"/helicopter/pose", "/sticks", "/tf"};
  contents.end_s = 12.34;
  ExportDialog dialog(contents);
  QSignalSpy started(&dialog, &ExportDialog::startRequested), cancelled(&dialog, &ExportDialog::cancelRequested);
  dialog.show();
  ASSERT_TRUE(QTest::qWaitForWindowExposed(&dialog));
  const auto button = [&](const char* text) -> QPushButton* {
    for (auto* one : dialog.findChildren<QPushButton*>())
      if (one->text() == QLatin1String(text)) return one;
    return nullptr;
  };
  auto* streams = dialog.findChild<QListWidget*>();
  ASSERT_EQ(streams->count(), 3);
  streams->item(2)->setCheckState(Qt::Unchecked);
  dialog.findChildren<QDoubleSpinBox*>().at(0)->setValue(2.5);
  ExportOrder order = dialog.order();
  EXPECT_EQ(order.topics, (std::set<std::string>{"/helicopter/pose", "/sticks"}));
  EXPECT_EQ(order.span.from, fromSeconds(2.5));
  EXPECT_TRUE(order.tables && order.png && order.pdf);
  EXPECT_FALSE(order.films || order.scene) << "there are no images, and the scene takes its time";
  savePicture(dialog, "export");
  QTest::mouseClick(button("None"), Qt::LeftButton);
  EXPECT_FALSE(button("Export")->isEnabled()) << "tables of nothing";
  QTest::mouseClick(button("All"), Qt::LeftButton);
  QTest::mouseClick(button("Export"), Qt::LeftButton);
  ASSERT_EQ(started.count(), 1);
  EXPECT_FALSE(button("Export")->isEnabled());
  dialog.showProgress(0.4, QStringLiteral("Tables"));
  EXPECT_EQ(dialog.findChild<QProgressBar*>()->value(), 400);
  QTest::mouseClick(button("Cancel"), Qt::LeftButton);
  EXPECT_EQ(cancelled.count(), 1);
  dialog.showEnd(QStringLiteral("Cancelled"));
  EXPECT_TRUE(button("Export")->isEnabled());
  EXPECT_NE(button("Close"), nullptr);
}

TEST(RecordedFlights, AreFilmedInTheScene) {
  const test::TemporaryFolder folder;
  record(folder / "a.mcap", 5, 0, 240);
  ExportOrder order;
  order.session = folder / "a.mcap";
  order.folder = folder / "film";
  order.span = {fromSeconds(2.0), fromSeconds(3.0)};
  SceneFilm film(order);
  QSignalSpy progressed(&film, &SceneFilm::progressed), finished(&film, &SceneFilm::finished);
  film.start();
  ASSERT_TRUE(QTest::qWaitFor([&] { return finished.count() > 0; }, kPatienceMs));
  EXPECT_EQ(finished.first().first().toString(), QString());
  EXPECT_EQ(progressed.count(), 31);
  EXPECT_GT(std::filesystem::file_size(film.file()), 2000u);
}

}  // namespace
}  // namespace helical
