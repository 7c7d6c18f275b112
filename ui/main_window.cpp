#include "ui/main_window.h"

#include <QActionGroup>
#include <QApplication>
#include <QDockWidget>
#include <QDropEvent>
#include <QFileDialog>
#include <QLabel>
#include <QMenuBar>
#include <QMessageBox>
#include <QMimeData>
#include <QPushButton>
#include <QScreen>
#include <QScrollArea>
#include <QSettings>
#include <QStatusBar>
#include <QToolButton>
#include <QVBoxLayout>
#include <algorithm>
#include <string>

#include "engine/base/log.h"
#include "engine/geometry/rotation.h"
#include "ui/alarm_bar.h"
#include "ui/calibration_panel.h"
#include "ui/camera_pane.h"
#include "ui/camera_wall.h"
#include "ui/emergency_stop.h"
#include "ui/event_list.h"
#include "ui/flight_panel.h"
#include "ui/format.h"
#include "ui/panel_title.h"
#include "ui/playback_bar.h"
#include "ui/plot_deck.h"
#include "ui/scene_view.h"
#include "ui/startup_time.h"
#include "ui/theme.h"
#include "ui/top_bar.h"

namespace helical {
namespace {

constexpr int kTickMs = 16;
// In timer ticks. Numbers that change faster than this cannot be read.
constexpr std::uint64_t kPictureEvery = 2;
constexpr std::uint64_t kSceneEvery = 3;
// Setting up OpenGL takes a whole core for a moment: not while the cameras take their background.
constexpr TimeNs kSceneFrom = kNanosecondsPerSecond;
constexpr std::uint64_t kPlotsEvery = 5;
constexpr std::uint64_t kNumbersEvery = 6;
constexpr double kGustSeconds = 1.5;
constexpr int kLayoutVersion = 1;  // another number when panels are added: old places would not fit
constexpr const char* kGeometryKey = "window/geometry";
constexpr const char* kPanelsKey = "window/panels";

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
  scroll->setWidgetResizable(true);
  scroll->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  return scroll;
}

}  // namespace

MainWindow::MainWindow(const RigConfig& rig, const WindowOptions& options) : rig_(rig), options_(options) {
  setWindowTitle(tr("Helical Ground Control"));
  setMinimumSize(1120, 640);
  setDockNestingEnabled(true);
  setCorner(Qt::BottomLeftCorner, Qt::LeftDockWidgetArea);
  setCorner(Qt::BottomRightCorner, Qt::RightDockWidgetArea);
  top_bar_ = new TopBar(rig_);
  setMenuWidget(top_bar_);
  buildPanels();
  buildMenus();
  buildStatusBar();
  alarms_ = new AlarmBar(this);
  scene_->setFocus();
  if (std::any_of(rig_.cameras.begin(), rig_.cameras.end(),
                  [](const CameraConfig& camera) { return camera.learns(); })) {
    // What a newcomer should see first: the camera that finds its place.
    viewpoints_->actions().at(static_cast<int>(SceneViewpoint::kIso))->trigger();
    plots_->showSheet(PlotDeck::kCalibration);
  }

  connect(top_bar_, &TopBar::armRequested, this, &MainWindow::arm);
  connect(top_bar_, &TopBar::takeOffRequested, this, &MainWindow::takeOff);
  connect(top_bar_, &TopBar::landRequested, this, &MainWindow::land);
  connect(top_bar_, &TopBar::stopRequested, this, &MainWindow::stop);
  connect(new EmergencyStop(this), &EmergencyStop::pressed, this, &MainWindow::stop);
  timer_.setTimerType(Qt::PreciseTimer);
  connect(&timer_, &QTimer::timeout, this, &MainWindow::tick);
}

MainWindow::~MainWindow() = default;

void MainWindow::attach(Engine& engine) {
  engine_ = &engine;
  watch(engine);
}

void MainWindow::attach(FlightPlayback& playback) {
  playback_bar_ = new PlaybackBar(playback);
  statusBar()->insertWidget(0, playback_bar_, 1);
  newest_event_->hide();
  setWindowTitle(tr("%1 - recorded flight").arg(QString::fromStdString(playback.file().filename().string())));
  watch(playback);
}

void MainWindow::watch(FlightView& view) {
  view_ = &view;
  scene_->setPlan(view.plan());
  since_load_.start();
  timer_.start(kTickMs);
}

void MainWindow::detach() {
  timer_.stop();
  view_ = nullptr;
  engine_ = nullptr;
}

void MainWindow::fitToScreen() {
  const QRect room = QGuiApplication::primaryScreen()->availableGeometry();
  const QSize size(std::min(room.width(), 1920), std::min(room.height(), 1080));
  setGeometry(QRect(
      room.topLeft() + QPoint((room.width() - size.width()) / 2, (room.height() - size.height()) / 2), size));
  arrangeDocks();
}

bool MainWindow::restoreLayout() {
  if (options_.layout_file.isEmpty()) return false;
  const QSettings layout(options_.layout_file, QSettings::IniFormat);
  return restoreGeometry(layout.value(kGeometryKey).toByteArray()) &&
         restoreState(layout.value(kPanelsKey).toByteArray(), kLayoutVersion);
}

void MainWindow::saveLayout() const {
  if (options_.layout_file.isEmpty()) return;
  QSettings layout(options_.layout_file, QSettings::IniFormat);
  layout.setValue(kGeometryKey, saveGeometry());
  layout.setValue(kPanelsKey, saveState(kLayoutVersion));
}

void MainWindow::closeEvent(QCloseEvent* event) {
  saveLayout();
  QMainWindow::closeEvent(event);
}

void MainWindow::resizeEvent(QResizeEvent* event) {
  QMainWindow::resizeEvent(event);
  alarms_->place(top_bar_->height() + 40);
}

void MainWindow::buildPanels() {
  scene_ = new SceneView(rig_);
  scene_title_ = new PanelTitle(tr("3D scene"), theme::kActive);
  buildSceneTitle(*scene_title_);
  auto* center = new QWidget;
  auto* layout = new QVBoxLayout(center);
  layout->setContentsMargins(0, 5, 0, 0);
  layout->setSpacing(0);
  layout->addWidget(scene_title_);
  layout->addWidget(framed(scene_), 1);
  setCentralWidget(center);

  cameras_ = new CameraWall(rig_);
  cameras_dock_ = addPanel(new PanelTitle(tr("Cameras"), theme::kActive), cameras_, Qt::LeftDockWidgetArea);
  connect(cameras_, &CameraWall::firstImagePainted, this, &MainWindow::noteFirstImage);
  connect(cameras_, &CameraWall::hideRequested, this, [this](CameraId camera, bool hidden) {
    if (engine_) engine_->hideCamera(camera, hidden);
  });
  connect(cameras_, &CameraWall::boardsChanged, this, [this](CameraId camera, const WhiteBoards& boards) {
    if (engine_) engine_->setBoards(camera, boards);
  });
  connect(cameras_, &CameraWall::knockRequested, this,
          [this](CameraId camera, double angle_deg, double distance_m) {
            if (engine_) engine_->knockCamera(camera, toRadians(angle_deg), distance_m);
          });
  plots_ = new PlotDeck(rig_);
  auto* plots_title = new PanelTitle(tr("Plots"), theme::kActive);
  plots_->addControls(*plots_title);
  plots_dock_ = addPanel(plots_title, framed(plots_), Qt::BottomDockWidgetArea);
  flight_ = new FlightPanel;
  flight_dock_ = addPanel(new PanelTitle(tr("Flight"), theme::kActive), framed(scrolled(flight_)),
                          Qt::RightDockWidgetArea);
  calibration_ = new CalibrationPanel(rig_, Engine::calibrators());
  connect(calibration_, &CalibrationPanel::methodChosen, this, &MainWindow::chooseMethod);
  connect(calibration_, &CalibrationPanel::restartRequested, this, [this](CameraId camera) {
    if (engine_) engine_->restartCalibration(camera);
  });
  calibration_dock_ = addPanel(new PanelTitle(tr("Calibration"), theme::kActive),
                               framed(scrolled(calibration_)), Qt::RightDockWidgetArea);
  events_ = new EventList;
  events_dock_ =
      addPanel(new PanelTitle(tr("Events"), theme::kActive), framed(events_), Qt::RightDockWidgetArea);
}

QDockWidget* MainWindow::addPanel(PanelTitle* title, QWidget* content, Qt::DockWidgetArea area) {
  auto* dock = new QDockWidget(title->name());
  dock->setObjectName(title->name());
  dock->setWidget(content);
  dock->setTitleBarWidget(title);
  addDockWidget(area, dock);
  return dock;
}

void MainWindow::buildSceneTitle(PanelTitle& title) {
  viewpoints_ = new QActionGroup(this);
  const std::array<std::pair<QString, QString>, 3> names{
      {{tr("Follow"), tr("The eye goes with the helicopter")},
       {tr("Top"), tr("From above, +x to the right")},
       {tr("Iso"), tr("All of the field, from the side")}}};
  for (std::size_t i = 0; i < names.size(); ++i) {
    QAction* action = viewpoints_->addAction(names[i].first);
    action->setCheckable(true);
    action->setToolTip(names[i].second);
    action->setChecked(i == 0);
    connect(action, &QAction::triggered, this, [this, i] { scene_->look(static_cast<SceneViewpoint>(i)); });
    auto* button = new QToolButton;
    button->setObjectName(QStringLiteral("small"));
    button->setDefaultAction(action);
    button->setFont(theme::uiFont(8, QFont::Medium));
    button->setFixedHeight(19);
    button->setFocusPolicy(Qt::TabFocus);
    button->setAccessibleName(tr("%1 view").arg(names[i].first));
    title.addWidget(button);
  }
}

void MainWindow::buildMenus() {
  buildFileMenu();
  buildFlightMenu();
  buildCameraMenu();
  buildDisturbMenu();
  buildViewMenu();
  buildHelpMenu();
}

void MainWindow::buildFileMenu() {
  setAcceptDrops(true);
  QMenu* menu = top_bar_->menuBar()->addMenu(tr("F&ile"));
  menu->addAction(tr("Open session..."), QKeySequence::Open, this, &MainWindow::chooseSession);
}

void MainWindow::chooseSession() {
  const QString file = QFileDialog::getOpenFileName(this, tr("Open a recorded flight"),
                                                    options_.session_folder, tr("Sessions (*.mcap)"));
  if (!file.isEmpty()) Q_EMIT sessionChosen(file);
}

void MainWindow::dragEnterEvent(QDragEnterEvent* event) {
  if (event->mimeData()->hasUrls() && event->mimeData()->urls().first().isLocalFile())
    event->acceptProposedAction();
}

void MainWindow::dropEvent(QDropEvent* event) {
  Q_EMIT sessionChosen(event->mimeData()->urls().first().toLocalFile());
}

void MainWindow::buildFlightMenu() {
  QMenu* menu = top_bar_->menuBar()->addMenu(tr("&Flight"));
  take_off_action_ = menu->addAction(tr("Take off"), this, &MainWindow::takeOff);
  land_action_ = menu->addAction(tr("Land"), this, &MainWindow::land);
  // Esc is named, not set as shortcut: the application-wide filter has it before any shortcut could.
  menu->addAction(tr("STOP\tEsc"), this, &MainWindow::stop);
  menu->addSeparator();
  menu->addAction(tr("Quit"), QKeySequence::Quit, this, &QWidget::close);
  take_off_action_->setEnabled(false);
  land_action_->setEnabled(false);
}

void MainWindow::buildCameraMenu() {
  QMenu* menu = top_bar_->menuBar()->addMenu(tr("&Cameras"));
  for (int i = 0; i < cameras_->count(); ++i) {
    const QString name = QString::fromStdString(rig_.cameras[static_cast<std::size_t>(i)].name);
    QAction* action = menu->addAction(tr("Hide %1").arg(name));
    action->setCheckable(true);
    if (i < 9) action->setShortcut(QKeySequence(Qt::Key_1 + i));
    connect(action, &QAction::triggered, this, [this, i](bool hidden) {
      if (engine_) engine_->hideCamera(cameraId(i), hidden);
    });
    hide_actions_.push_back(action);
  }
}

void MainWindow::buildDisturbMenu() {
  QMenu* menu = top_bar_->menuBar()->addMenu(tr("&Disturb"));
  if (!rig_.cameras.empty() && rig_.cameras.front().source == "sim") {
    const auto add = [&](const QString& text, double speed) {
      menu->addAction(text, this, [this, speed] {
        if (engine_) engine_->gust({speed, 0.3 * speed, 0.0}, kGustSeconds);
      });
    };
    add(tr("Light gust (0.8 m/s)"), 0.8);
    add(tr("Strong gust (2 m/s)"), 2.0);
    menu->addSeparator();
  }
  for (int i = 0; i < cameras_->count(); ++i)
    menu->addMenu(QString::fromStdString(rig_.cameras[static_cast<std::size_t>(i)].name))
        ->addActions(cameras_->pane(i).disturbances());
}

void MainWindow::buildViewMenu() {
  QMenu* menu = top_bar_->menuBar()->addMenu(tr("&View"));
  for (QAction* action : viewpoints_->actions()) menu->addAction(action);
  menu->addSeparator();
  for (QDockWidget* dock : {cameras_dock_, plots_dock_, flight_dock_, calibration_dock_, events_dock_})
    menu->addAction(dock->toggleViewAction());
  menu->addAction(tr("Default layout"), this, &MainWindow::arrangeDocks);
  menu->addSeparator();
  QAction* coverage = menu->addAction(tr("Border of what two cameras see"));
  coverage->setCheckable(true);
  coverage->setChecked(true);
  connect(coverage, &QAction::toggled, this, [this](bool shown) { scene_->setCoverageShown(shown); });
  QAction* live = menu->addAction(tr("Pause the plots"));
  live->setCheckable(true);
  live->setShortcut(QKeySequence(Qt::Key_Space));
  connect(live, &QAction::triggered, this, [this](bool paused) { plots_->axis().setLive(!paused); });
  connect(&plots_->axis(), &TimeAxis::liveChanged, live, [live](bool on) { live->setChecked(!on); });
  QAction* full = menu->addAction(tr("Full screen"));
  full->setCheckable(true);
  full->setShortcut(QKeySequence(Qt::Key_F11));
  connect(full, &QAction::toggled, this, &MainWindow::toggleFullScreen);
}

void MainWindow::buildHelpMenu() {
  QMenu* menu = top_bar_->menuBar()->addMenu(tr("&Help"));
  menu->addAction(tr("Keys"), QKeySequence(Qt::Key_F1), this, &MainWindow::showKeys);
  menu->addAction(tr("About Helical"), this, &MainWindow::showAbout);
}

void MainWindow::showKeys() {
  QMessageBox box(QMessageBox::NoIcon, tr("Keys"),
                  tr("<table cellpadding='4'>"
                     "<tr><td><b>Esc</b></td><td>STOP: rotors off at once, whatever has the focus</td></tr>"
                     "<tr><td><b>1 \u2026 9</b></td><td>hide or show a camera</td></tr>"
                     "<tr><td><b>Space</b></td><td>hold the plots still, or follow again</td></tr>"
                     "<tr><td><b>F11</b></td><td>full screen</td></tr>"
                     "<tr><td><b>Ctrl+Q</b></td><td>quit</td></tr></table>"),
                  QMessageBox::Ok, this);
  box.exec();
}

void MainWindow::showAbout() {
  QMessageBox box(QMessageBox::NoIcon, tr("About Helical"),
                  tr("<b>Helical</b><br>Ground control for small helicopters that carry no sensors.<br><br>"
                     "GPL-3.0-or-later"),
                  QMessageBox::Ok, this);
  box.exec();
}

void MainWindow::toggleFullScreen(bool full) {
  setWindowState(full ? windowState() | Qt::WindowFullScreen : windowState() & ~Qt::WindowFullScreen);
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
  statusBar()->addWidget(newest_event_, 1);
  statusBar()->addPermanentWidget(load_);
}

void MainWindow::arrangeDocks() {
  const std::array<std::pair<QDockWidget*, Qt::DockWidgetArea>, 5> places{
      {{cameras_dock_, Qt::LeftDockWidgetArea},
       {plots_dock_, Qt::BottomDockWidgetArea},
       {flight_dock_, Qt::RightDockWidgetArea},
       {calibration_dock_, Qt::RightDockWidgetArea},
       {events_dock_, Qt::RightDockWidgetArea}}};
  for (const auto& [dock, area] : places) {
    dock->setFloating(false);
    addDockWidget(area, dock);
    dock->show();
  }
  // Three 4:3 pictures above each other fill the height; more cameras get more width.
  const int per_camera = (height() - 110) / std::clamp(cameras_->count(), 1, 3) - 32;
  const int wanted = cameras_->count() > 3 ? width() * 2 / 5 : per_camera * 4 / 3;
  const int cameras_width = std::clamp(wanted, std::min(360, width() * 23 / 100), width() * 2 / 5);
  resizeDocks({cameras_dock_, flight_dock_}, {cameras_width, 278}, Qt::Horizontal);
  resizeDocks({plots_dock_}, {height() * 28 / 100}, Qt::Vertical);
  const int flight_height = flight_->sizeHint().height() + 28;
  const int calibration_height = calibration_->sizeHint().height() + 28;
  const int left = height() - 110 - flight_height - calibration_height;
  resizeDocks({flight_dock_, calibration_dock_, events_dock_},
              {flight_height, calibration_height, std::max(80, left)}, Qt::Vertical);
}

void MainWindow::chooseMethod(const QString& method) {
  if (engine_) engine_->setCalibrator(method.toStdString());
}

void MainWindow::arm(bool arm) {
  if (engine_ == nullptr) return;
  if (arm)
    engine_->arm();
  else
    engine_->disarm();
}

void MainWindow::takeOff() {
  if (engine_) engine_->takeOff();
}

void MainWindow::land() {
  if (engine_) engine_->land();
}

void MainWindow::stop() {
  if (engine_) engine_->kill();
}

void MainWindow::tick() {
  ++ticks_;
  view_->poll();
  if (playback_bar_ != nullptr) playback_bar_->refresh();
  fetchTicks();
  EngineEvent event;
  while (view_->nextEvent(event)) {
    events_->add(event);
    alarms_->add(event);
    newest_event_->setText(QString::fromUtf8(event.text.data()));
  }
  if (ticks_ % kPictureEvery == 0) fetchPictures();
  if (ticks_ % kSceneEvery == 0) fetchCalibrations();
  const EngineSnapshot& snapshot = view_->snapshot();
  if (ticks_ % kSceneEvery == 0 && snapshot.time > kSceneFrom) scene_->show(snapshot);
  if (ticks_ % kPlotsEvery == 1) plots_->redraw();
  if (ticks_ % kNumbersEvery == 1 && snapshot.tick > 0) showNumbers(snapshot);
  if (since_load_.elapsed() >= 1000) showLoad();
  if (options_.auto_take_off && !took_off_by_itself_ && snapshot.pose_known && snapshot.failing_checks == 0) {
    took_off_by_itself_ = true;
    arm(true);
    takeOff();
  }
}

void MainWindow::fetchTicks() {
  EngineSnapshot tick;
  while (view_->nextTick(tick)) {
    plots_->addTick(tick);
    scene_->addTick(tick);
    for (int i = 0; i < std::min(tick.camera_count, cameras_->count()); ++i)
      cameras_->pane(i).addTrack(tick.cameras[static_cast<std::size_t>(i)].track);
  }
}

void MainWindow::fetchPictures() {
  for (int i = 0; i < cameras_->count(); ++i)
    if (view_->pollPicture(cameraId(i))) cameras_->pane(i).setPicture(view_->picture(cameraId(i)));
}

void MainWindow::fetchCalibrations() {
  for (int i = 0; i < cameras_->count(); ++i) {
    if (!view_->pollCalibration(cameraId(i))) continue;
    const CalibrationView& view = view_->calibration(cameraId(i));
    scene_->setCalibration(i, view);
    calibration_->setHypotheses(i, view.total);
  }
}

void MainWindow::showNumbers(const EngineSnapshot& snapshot) {
  for (int i = 0; i < std::min(snapshot.camera_count, cameras_->count()); ++i) {
    const CameraSnapshot& camera = snapshot.cameras[static_cast<std::size_t>(i)];
    cameras_->pane(i).setState(camera, snapshot);
    hide_actions_[static_cast<std::size_t>(i)]->setChecked(camera.hidden);
  }
  top_bar_->show(snapshot);
  if (engine_ == nullptr) {
    // Nobody flies here.
    top_bar_->takeOffButton()->setEnabled(false);
    top_bar_->landButton()->setEnabled(false);
  }
  take_off_action_->setEnabled(top_bar_->takeOffButton()->isEnabled());
  land_action_->setEnabled(top_bar_->landButton()->isEnabled());
  flight_->show(snapshot);
  calibration_->show(snapshot);
}

void MainWindow::showLoad() {
  const double seconds = static_cast<double>(since_load_.restart()) * 1e-3;
  const double gui_hz = static_cast<double>(ticks_ - ticks_at_load_) / seconds;
  const double scene_hz = (scene_->renderedFrames() - scenes_at_load_) / seconds;
  ticks_at_load_ = ticks_;
  scenes_at_load_ = scene_->renderedFrames();
  load_->setText(tr("GUI %1 Hz   3D %2 ms   lost ticks %3")
                     .arg(plainNumber(gui_hz, 1), plainNumber(scene_->renderMilliseconds(), 1))
                     .arg(view_->lostTicks()));
  scene_title_->setNote(tr("%1 Hz").arg(plainNumber(scene_hz, 0)));
}

void MainWindow::noteFirstImage() {
  if (first_image_) return;
  first_image_ = sinceProcessStart();
  if (!first_image_) return;
  log(LogLevel::kDebug,
      "first image after " + std::to_string(*first_image_ / kNanosecondsPerMillisecond) + " ms");
  Q_EMIT firstImage(*first_image_);
}

}  // namespace helical
