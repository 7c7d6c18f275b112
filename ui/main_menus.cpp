#include "ui/main_menus.h"

#include <QDockWidget>
#include <QMainWindow>
#include <QMenu>
#include <QMenuBar>

#include "ui/camera_pane.h"
#include "ui/camera_tools.h"
#include "ui/camera_wall.h"
#include "ui/plot_deck.h"
#include "ui/scene_view.h"
#include "ui/theme.h"

namespace helical {

namespace {

bool haveImages(const RigConfig& rig) {
  return rig.simulation.images || rig.cameras.empty() || rig.cameras.front().source != "sim";
}

}  // namespace

MainMenus::MainMenus(const RigConfig& rig, const Panels& panels, QMenuBar& bar, QMainWindow& window)
    : QObject(&window), rig_(rig), panels_(panels), window_(window) {
  QMenu* file = bar.addMenu(tr("F&ile"));
  file->addAction(tr("Open session..."), QKeySequence::Open, this, &MainMenus::openRequested);
  file->addAction(tr("Export session..."), QKeySequence(Qt::CTRL | Qt::Key_E), this,
                  &MainMenus::exportRequested);
  file->addAction(tr("Compare sessions..."), this, &MainMenus::compareRequested);
  file->addSeparator();
  pictures_ = file->addAction(tr("Record the cameras' pictures"));
  pictures_->setShortcut(QKeySequence(Qt::CTRL | Qt::Key_R));
  pictures_->setCheckable(true);
  pictures_->setEnabled(false);
  connect(pictures_, &QAction::triggered, this, &MainMenus::picturesRequested);
  buildFlight(*bar.addMenu(tr("&Flight")));
  buildCameras(*bar.addMenu(tr("&Cameras")));
  buildDisturb(*bar.addMenu(tr("&Disturb")));
  buildView(*bar.addMenu(tr("&View")));
  QMenu* help = bar.addMenu(tr("&Help"));
  help->addAction(tr("Manual"), QKeySequence(Qt::CTRL | Qt::Key_F1), this, &MainMenus::manualRequested);
  help->addAction(tr("Keys and mouse"), QKeySequence(Qt::Key_F1), this, &MainMenus::keysRequested);
  help->addAction(tr("About Helical"), this, &MainMenus::aboutRequested);
}

void MainMenus::buildFlight(QMenu& menu) {
  take_off_ = menu.addAction(tr("Take off"), this, &MainMenus::takeOffRequested);
  land_ = menu.addAction(tr("Land"), this, &MainMenus::landRequested);
  // Esc is named, not set as shortcut: the application-wide filter has it before any shortcut could.
  menu.addAction(tr("STOP\tEsc"), this, &MainMenus::stopRequested);
  menu.addSeparator();
  if (isUsb(rig_.transmitter)) {
    channels_ = menu.addAction(tr("Channels of the transmitter\u2026"), this, &MainMenus::channelsRequested);
    channels_->setEnabled(false);
    menu.addSeparator();
  }
  menu.addAction(tr("Quit"), QKeySequence::Quit, &window_, &QWidget::close);
  take_off_->setEnabled(false);
  land_->setEnabled(false);
}

void MainMenus::buildCameras(QMenu& menu) {
  for (int i = 0; i < panels_.cameras.count(); ++i) {
    const QString name = QString::fromStdString(rig_.cameras[static_cast<std::size_t>(i)].name);
    QAction* action = menu.addAction(tr("Hide %1").arg(name));
    action->setCheckable(true);
    if (i < 9) action->setShortcut(QKeySequence(Qt::Key_1 + i));
    connect(action, &QAction::triggered, this,
            [this, i](bool hidden) { Q_EMIT hideRequested(cameraId(i), hidden); });
    hide_.push_back(action);
  }
  if (!haveImages(rig_)) return;
  menu.addSeparator();
  background_ = menu.addAction(tr("Take a new background"), this, &MainMenus::backgroundRequested);
  menu.addAction(tr("Colour of the markers\u2026"), this, &MainMenus::colourRequested);
}

void MainMenus::buildDisturb(QMenu& menu) {
  if (!rig_.cameras.empty() && rig_.cameras.front().source == "sim") {
    const auto add = [&](const QString& text, double speed) {
      menu.addAction(text, this, [this, speed] { Q_EMIT gustRequested(speed); });
    };
    add(tr("Light gust (0.8 m/s)"), 0.8);
    add(tr("Strong gust (2 m/s)"), 2.0);
    menu.addSeparator();
  }
  for (int i = 0; i < panels_.cameras.count(); ++i)
    menu.addMenu(QString::fromStdString(rig_.cameras[static_cast<std::size_t>(i)].name))
        ->addActions(panels_.cameras.pane(i).tools().disturbances());
}

void MainMenus::buildView(QMenu& menu) {
  menu.addActions(panels_.viewpoints);
  menu.addSeparator();
  buildPanels(menu);
  menu.addSeparator();
  const auto add = [&](const QString& text, DockLayouts::Layout layout) {
    menu.addAction(text, this, [this, layout] { Q_EMIT layoutRequested(layout); });
  };
  add(tr("Layout: Fly"), DockLayouts::Layout::kFly);
  add(tr("Layout: Calibrate"), DockLayouts::Layout::kCalibrate);
  add(tr("Layout: Analyse"), DockLayouts::Layout::kAnalyse);
  menu.addSeparator();
  QAction* coverage = menu.addAction(tr("Border of what two cameras see"));
  coverage->setCheckable(true);
  coverage->setChecked(true);
  connect(coverage, &QAction::toggled, this, [this](bool shown) { panels_.scene.setCoverageShown(shown); });
  QAction* live = menu.addAction(tr("Pause the plots"));
  live->setCheckable(true);
  live->setShortcut(QKeySequence(Qt::Key_Space));
  TimeAxis& axis = panels_.plots.axis();
  connect(live, &QAction::triggered, this, [&axis](bool paused) { axis.setLive(!paused); });
  connect(&axis, &TimeAxis::liveChanged, live, [live](bool on) { live->setChecked(!on); });
  light_ = menu.addAction(tr("Light theme"));
  light_->setCheckable(true);
  light_->setChecked(theme::theme() == theme::Theme::kLight);
  connect(light_, &QAction::toggled, this, &MainMenus::lightToggled);
  QAction* sound = menu.addAction(tr("Sound of alarms"));
  sound->setCheckable(true);
  sound->setChecked(true);
  connect(sound, &QAction::toggled, this, &MainMenus::soundToggled);
  QAction* full = menu.addAction(tr("Full screen"));
  full->setCheckable(true);
  full->setShortcut(QKeySequence(Qt::Key_F11));
  connect(full, &QAction::toggled, this, [this](bool on) {
    window_.setWindowState(on ? window_.windowState() | Qt::WindowFullScreen
                              : window_.windowState() & ~Qt::WindowFullScreen);
  });
}

void MainMenus::buildPanels(QMenu& menu) {
  for (QDockWidget* dock : panels_.docks) menu.addAction(dock->toggleViewAction());
  QMenu* windows = menu.addMenu(tr("Panel in a window of its own"));
  for (QDockWidget* dock : panels_.docks) {
    QAction* action = windows->addAction(dock->windowTitle());
    action->setCheckable(true);
    connect(action, &QAction::triggered, dock, [dock](bool own) {
      dock->show();
      dock->setFloating(own);
    });
    connect(dock, &QDockWidget::topLevelChanged, action, &QAction::setChecked);
  }
}

void MainMenus::setLight(bool on) {
  light_->setChecked(on);
}

void MainMenus::show(const EngineSnapshot& snapshot, bool can_take_off, bool can_land) {
  take_off_->setEnabled(can_take_off);
  land_->setEnabled(can_land);
  const bool standing = snapshot.phase == FlightPhase::kIdle || snapshot.phase == FlightPhase::kOff;
  if (background_ != nullptr) background_->setEnabled(standing);
  if (channels_ != nullptr) channels_->setEnabled(standing && !snapshot.armed);
  for (std::size_t i = 0; i < hide_.size(); ++i) hide_[i]->setChecked(snapshot.cameras[i].hidden);
}

void MainMenus::showRecord(bool recorded, bool pictures) {
  pictures_->setEnabled(recorded && haveImages(rig_));
  pictures_->setChecked(pictures);
}

}  // namespace helical
