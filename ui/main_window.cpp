#include "ui/main_window.h"

#include <QApplication>
#include <QDockWidget>
#include <QDropEvent>
#include <QLabel>
#include <QMessageBox>
#include <QMimeData>
#include <QPushButton>
#include <QScreen>
#include <QScrollArea>
#include <QStatusBar>
#include <QVBoxLayout>
#include <algorithm>

#include "engine/base/error.h"
#include "engine/config/resource_files.h"
#include "ui/alarm_bar.h"
#include "ui/attitude_indicator.h"
#include "ui/button_keys.h"
#include "ui/calibration_panel.h"
#include "ui/camera_wall.h"
#include "ui/colour_tool.h"
#include "ui/emergency_stop.h"
#include "ui/engine_orders.h"
#include "ui/event_list.h"
#include "ui/event_panel.h"
#include "ui/flight_panel.h"
#include "ui/key_sheet.h"
#include "ui/main_menus.h"
#include "ui/manual_window.h"
#include "ui/open_dialog.h"
#include "ui/panel_title.h"
#include "ui/plan_editor.h"
#include "ui/playback_bar.h"
#include "ui/plot_deck.h"
#include "ui/record_label.h"
#include "ui/scene_view.h"
#include "ui/status_words.h"
#include "ui/theme.h"
#include "ui/top_bar.h"
#include "ui/tuning_editor.h"
#include "ui/viewpoints.h"

namespace helical {
namespace {

constexpr int kTickMs = 16;

QWidget* framed(QWidget* content) {
  auto* box = new QWidget;
  box->setObjectName(QStringLiteral("panel"));
  box->setAttribute(Qt::WA_StyledBackground);
  auto* layout = new QVBoxLayout(box);
  layout->setContentsMargins(1, 0, 1, 1);
  layout->addWidget(content);
  return box;
}

QScrollArea* scrolled(QWidget* content) {
  auto* scroll = new QScrollArea;
  scroll->setWidget(content);
  content->setAutoFillBackground(false);  // setWidget wants it filled, with another colour than the panel's
  scroll->setWidgetResizable(true);
  scroll->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  return scroll;
}

}  // namespace

MainWindow::MainWindow(const RigConfig& rig, const WindowOptions& options)
    : rig_(rig), options_(options), orders_(new EngineOrders(this)) {
  setWindowTitle(tr("Helical Ground Control"));
  setMinimumSize(1120, 640);
  setDockNestingEnabled(true);
  setCorner(Qt::BottomLeftCorner, Qt::LeftDockWidgetArea);
  setCorner(Qt::BottomRightCorner, Qt::RightDockWidgetArea);
  top_bar_ = new TopBar(rig_);
  setMenuWidget(top_bar_);
  buildPanels();
  layouts_ = std::make_unique<DockLayouts>(*this, docks_, options_.layout_file);
  buildMenus();
  buildStatusBar();
  alarms_ = new AlarmBar(this);
  connect(alarms_, &AlarmBar::acknowledged, this, [this] { events_->list().acknowledge(); });
  connect(menus_, &MainMenus::soundToggled, alarms_, &AlarmBar::setSound);
  scene_->setFocus();
  if (std::any_of(rig_.cameras.begin(), rig_.cameras.end(),
                  [](const CameraConfig& camera) { return camera.learns(); })) {
    // What a newcomer should see first: the camera that finds its place.
    viewpoints_->lookFromTheSide();
    plots_->showSheet(PlotDeck::kCalibration);
  }

  connect(top_bar_, &TopBar::armRequested, orders_, &EngineOrders::arm);
  connect(top_bar_, &TopBar::takeOffRequested, orders_, &EngineOrders::takeOff);
  connect(top_bar_, &TopBar::holdRequested, orders_, &EngineOrders::hold);
  connect(top_bar_, &TopBar::landRequested, orders_, &EngineOrders::land);
  connect(top_bar_, &TopBar::stopRequested, orders_, &EngineOrders::stop);
  connect(new EmergencyStop(top_bar_->stopButton(), this), &EmergencyStop::pressed, orders_,
          &EngineOrders::stop);
  new ButtonKeys(this);
  timer_.setTimerType(Qt::PreciseTimer);
  connect(&timer_, &QTimer::timeout, this, &MainWindow::tick);
}

MainWindow::~MainWindow() = default;

void MainWindow::attach(Engine& engine) {
  engine_ = &engine;
  orders_->setEngine(&engine);
  gains_->setControl(engine.control());
  watch(engine);
}

void MainWindow::attach(FlightPlayback& playback) {
  playback_bar_ = new PlaybackBar(playback);
  statusBar()->insertWidget(0, playback_bar_, 1);
  newest_event_->hide();
  record_->hide();
  session_file_ = QString::fromStdString(playback.file().string());
  // Nobody flies here.
  plan_->setEnabled(false);
  gains_->setEnabled(false);
  calibration_->setCommands(false);
  setWindowTitle(tr("%1 - recorded flight").arg(QString::fromStdString(playback.file().filename().string())));
  watch(playback);
}

void MainWindow::watch(FlightView& view) {
  view_ = &view;
  plan_->setPlan(view.plan());
  since_load_.start();
  timer_.start(kTickMs);
}

void MainWindow::detach() {
  timer_.stop();
  view_ = nullptr;
  orders_->setEngine(nullptr);
  engine_ = nullptr;
}

void MainWindow::fitToScreen() {
  const QRect room = QGuiApplication::primaryScreen()->availableGeometry();
  const QSize size(std::min(room.width(), 1920), std::min(room.height(), 1080));
  setGeometry(QRect(
      room.topLeft() + QPoint((room.width() - size.width()) / 2, (room.height() - size.height()) / 2), size));
  arrange(DockLayouts::Layout::kFly);
}

bool MainWindow::restoreLayout() {
  const bool restored = layouts_->restore();
  menus_->setLight(layouts_->light());
  return restored;
}

void MainWindow::arrange(DockLayouts::Layout layout) {
  layouts_->arrange(layout, cameras_->count());
  if (layout == DockLayouts::Layout::kCalibrate) plots_->showSheet(PlotDeck::kCalibration);
}

void MainWindow::closeEvent(QCloseEvent* event) {
  layouts_->save();
  QMainWindow::closeEvent(event);
}

void MainWindow::resizeEvent(QResizeEvent* event) {
  QMainWindow::resizeEvent(event);
  alarms_->place(top_bar_->height() + 40);
}

void MainWindow::buildPanels() {
  scene_ = new SceneView(rig_);
  scene_title_ = new PanelTitle(tr("3D scene"), theme::kActive);
  viewpoints_ = new Viewpoints(rig_, *scene_, this);
  viewpoints_->addButtons(*scene_title_);
  auto* center = new QWidget;
  auto* layout = new QVBoxLayout(center);
  layout->setContentsMargins(0, 5, 0, 0);
  layout->setSpacing(0);
  layout->addWidget(scene_title_);
  layout->addWidget(framed(scene_), 1);
  setCentralWidget(center);

  cameras_ = new CameraWall(rig_);
  docks_.cameras = addPanel(new PanelTitle(tr("Cameras"), theme::kActive), cameras_, Qt::LeftDockWidgetArea);
  connectCameras();
  plots_ = new PlotDeck(rig_);
  auto* plots_title = new PanelTitle(tr("Plots"), theme::kActive);
  plots_->addControls(*plots_title);
  docks_.plots = addPanel(plots_title, framed(plots_), Qt::BottomDockWidgetArea);
  buildFlightPanels();
  calibration_ = new CalibrationPanel(rig_, Engine::calibrators());
  connect(calibration_, &CalibrationPanel::methodChosen, orders_, &EngineOrders::setCalibrator);
  connect(calibration_, &CalibrationPanel::restartRequested, orders_, &EngineOrders::restartCalibration);
  connect(calibration_, &CalibrationPanel::ordered, orders_, &EngineOrders::orderCalibration);
  connect(calibration_, &CalibrationPanel::placeLoadRequested, orders_, &EngineOrders::loadPlace);
  connect(calibration_, &CalibrationPanel::placeSaveRequested, orders_, &EngineOrders::savePlace);
  connect(calibration_, &CalibrationPanel::loadRequested, orders_, &EngineOrders::loadCalibration);
  connect(calibration_, &CalibrationPanel::saveRequested, orders_, &EngineOrders::saveCalibration);
  docks_.calibration = addPanel(new PanelTitle(tr("Calibration"), theme::kActive),
                                framed(scrolled(calibration_)), Qt::RightDockWidgetArea);
  events_ = new EventPanel;
  docks_.events =
      addPanel(new PanelTitle(tr("Events"), theme::kActive), framed(events_), Qt::RightDockWidgetArea);
}

void MainWindow::buildFlightPanels() {
  flight_ = new FlightPanel;
  attitude_ = new AttitudeIndicator;
  auto* state = new QWidget;
  auto* layout = new QVBoxLayout(state);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(0);
  layout->addWidget(attitude_);
  layout->addWidget(scrolled(flight_), 1);
  docks_.flight =
      addPanel(new PanelTitle(tr("Flight"), theme::kActive), framed(state), Qt::RightDockWidgetArea);
  plan_ = new PlanEditor;
  docks_.plan = addPanel(new PanelTitle(tr("Plan"), theme::kActive), framed(plan_), Qt::RightDockWidgetArea);
  gains_ = new TuningEditor(rig_.control);
  docks_.gains = addPanel(new PanelTitle(tr("Gains"), theme::kActive), framed(scrolled(gains_)),
                          Qt::RightDockWidgetArea);
  connect(plan_, &PlanEditor::draftChanged, this,
          [this](const FlightPlan& draft) { scene_->setPlan(draft, plan_->edited()); });
  connect(scene_, &SceneView::waypointDragged, plan_, &PlanEditor::moveWaypoint);
  connect(plan_, &PlanEditor::applyRequested, orders_, [this](const FlightPlan& plan) {
    orders_->change({plan, {}});
  });
  connect(gains_, &TuningEditor::applyRequested, orders_, [this](const ControllerOptions& control) {
    orders_->change({{}, control});
  });
  connect(orders_, &EngineOrders::changed, this, [this] {
    if (!engine_) return;
    plan_->setPlan(engine_->plan());
    gains_->setControl(engine_->control());
  });
}

void MainWindow::connectCameras() {
  connect(cameras_, &CameraWall::firstImagePainted, this, &MainWindow::noteFirstImage);
  connect(cameras_, &CameraWall::hideRequested, orders_, &EngineOrders::hideCamera);
  connect(cameras_, &CameraWall::boardsChanged, orders_, &EngineOrders::setBoards);
  connect(cameras_, &CameraWall::lossRequested, orders_, &EngineOrders::loseFrames);
  connect(cameras_, &CameraWall::noiseRequested, orders_, &EngineOrders::addNoise);
  connect(cameras_, &CameraWall::knockRequested, orders_, &EngineOrders::knock);
  colour_tool_ = new ColourTool(*cameras_, *orders_, this);
}

QDockWidget* MainWindow::addPanel(PanelTitle* title, QWidget* content, Qt::DockWidgetArea area) {
  auto* dock = new QDockWidget(title->name());
  dock->setObjectName(title->name());
  dock->setWidget(content);
  dock->setTitleBarWidget(title);
  addDockWidget(area, dock);
  return dock;
}

void MainWindow::buildMenus() {
  setAcceptDrops(true);
  menus_ = new MainMenus(rig_,
                         {*cameras_,
                          *scene_,
                          *plots_,
                          viewpoints_->actions(),
                          {docks_.cameras, docks_.plots, docks_.flight, docks_.plan, docks_.gains,
                           docks_.calibration, docks_.events}},
                         *top_bar_->menuBar(), *this);
  connect(menus_, &MainMenus::openRequested, this, &MainWindow::chooseSession);
  connect(menus_, &MainMenus::exportRequested, this, &MainWindow::chooseExport);
  connect(menus_, &MainMenus::compareRequested, this, &MainWindow::chooseComparison);
  connect(menus_, &MainMenus::picturesRequested, this, &MainWindow::recordPictures);
  connect(menus_, &MainMenus::takeOffRequested, orders_, &EngineOrders::takeOff);
  connect(menus_, &MainMenus::landRequested, orders_, &EngineOrders::land);
  connect(menus_, &MainMenus::channelsRequested, this, &MainWindow::askForChannels);
  connect(menus_, &MainMenus::stopRequested, orders_, &EngineOrders::stop);
  connect(menus_, &MainMenus::hideRequested, orders_, &EngineOrders::hideCamera);
  connect(menus_, &MainMenus::backgroundRequested, orders_, &EngineOrders::takeBackground);
  connect(menus_, &MainMenus::gustRequested, orders_, &EngineOrders::gust);
  connect(menus_, &MainMenus::colourRequested, colour_tool_, &ColourTool::open);
  connect(menus_, &MainMenus::lightToggled, this, [this](bool light) {
    layouts_->setLight(light);
    theme::apply(*qApp, light ? theme::Theme::kLight : theme::Theme::kDark);
  });
  connect(menus_, &MainMenus::layoutRequested, this, &MainWindow::arrange);
  connect(menus_, &MainMenus::manualRequested, this, &MainWindow::openManual);
  connect(menus_, &MainMenus::keysRequested, this, [this] { openDialog(new KeySheet(this)); });
  connect(menus_, &MainMenus::aboutRequested, this, [this] {
    openNotice(this, tr("About Helical"),
               tr("<b>Helical</b><br>Ground control for small helicopters that carry no sensors.<br><br>"
                  "GPL-3.0-or-later"));
  });
}

void MainWindow::recordPictures(bool on) {
  if (options_.pictures.turn) options_.pictures.turn(on);
}

void MainWindow::askForChannels() {
  auto* box =
      new QMessageBox(QMessageBox::NoIcon, tr("Channels of the transmitter"),
                      tr("The device belongs to the flight: this window closes, and comes back when the "
                         "channels are calibrated or you cancel. Go on?"),
                      QMessageBox::Yes | QMessageBox::No, this);
  connect(box, &QMessageBox::accepted, this, [this] {
    const EngineSnapshot& now = view_->snapshot();
    if (!now.armed && !inFlight(now.phase)) Q_EMIT channelsRequested();
  });
  openDialog(box);
}

void MainWindow::openManual() {
  try {
    const auto file = resourceFolder() / "manual" / "manual.md";
    openDialog(new ManualWindow(QString::fromStdString(file.string()), this));
  } catch (const Error& error) {
    openNotice(this, tr("Manual"), QString::fromUtf8(error.what()));
  }
}

void MainWindow::chooseSession() {
  askWhatToOpen(this, tr("Open a recorded flight"), options_.session_folder, tr("Sessions (*.mcap)"),
                [this](const QString& file) { Q_EMIT sessionChosen(file); });
}

void MainWindow::chooseExport() {
  if (!session_file_.isEmpty()) {
    Q_EMIT exportChosen(session_file_);
    return;
  }
  askWhatToOpen(this, tr("Export a recorded flight"), options_.session_folder, tr("Sessions (*.mcap)"),
                [this](const QString& file) { Q_EMIT exportChosen(file); });
}

void MainWindow::chooseComparison() {
  const QString title =
      session_file_.isEmpty() ? tr("Compare recorded flights") : tr("Compare this flight with others");
  askWhichToOpen(this, title, options_.session_folder, tr("Sessions (*.mcap)"), [this](QStringList files) {
    if (!session_file_.isEmpty() && !files.contains(session_file_)) files.prepend(session_file_);
    Q_EMIT comparisonChosen(files);
  });
}

void MainWindow::dragEnterEvent(QDragEnterEvent* event) {
  if (event->mimeData()->hasUrls() && event->mimeData()->urls().first().isLocalFile())
    event->acceptProposedAction();
}

void MainWindow::dropEvent(QDropEvent* event) {
  Q_EMIT sessionChosen(event->mimeData()->urls().first().toLocalFile());
}

void MainWindow::buildStatusBar() {
  newest_event_ = new QLabel(tr("Starting the engine"));
  newest_event_->setFont(theme::uiFont(8.4));
  newest_event_->setContentsMargins(10, 2, 10, 2);
  newest_event_->setAccessibleName(tr("Newest event"));
  load_ = new QLabel;
  load_->setFont(theme::monoFont(7.8));
  load_->setContentsMargins(10, 2, 10, 2);
  load_->setAccessibleName(tr("Load of this window"));
  load_->setToolTip(
      tr("Refreshes of this window, time to draw the 3D scene, engine ticks the window was too slow for"));
  statusBar()->setSizeGripEnabled(false);
  record_ = new RecordLabel;
  statusBar()->addWidget(newest_event_, 1);
  statusBar()->addPermanentWidget(record_);
  statusBar()->addPermanentWidget(load_);
}

void MainWindow::stop() {
  orders_->stop();
}

}  // namespace helical
