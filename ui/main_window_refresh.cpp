// How MainWindow hands what the engine says to its panels, each as often as it can be read.

#include <QDockWidget>
#include <QLabel>
#include <QPushButton>
#include <algorithm>
#include <string>

#include "engine/base/log.h"
#include "ui/alarm_bar.h"
#include "ui/attitude_indicator.h"
#include "ui/calibration_panel.h"
#include "ui/camera_pane.h"
#include "ui/camera_wall.h"
#include "ui/catalogue.h"
#include "ui/engine_orders.h"
#include "ui/event_panel.h"
#include "ui/flight_panel.h"
#include "ui/format.h"
#include "ui/hold_button.h"
#include "ui/main_menus.h"
#include "ui/main_window.h"
#include "ui/panel_title.h"
#include "ui/playback_bar.h"
#include "ui/plot_deck.h"
#include "ui/record_label.h"
#include "ui/scene_view.h"
#include "ui/startup_time.h"
#include "ui/top_bar.h"

namespace helical {
namespace {

// In timer ticks. Numbers that change faster than this cannot be read.
constexpr std::uint64_t kPictureEvery = 2;
constexpr std::uint64_t kSceneEvery = 3;
// Setting up OpenGL takes a whole core for a moment: not while the cameras take their background.
constexpr TimeNs kSceneFrom = kNanosecondsPerSecond;
constexpr std::uint64_t kPlotsEvery = 5;
constexpr std::uint64_t kNumbersEvery = 6;

}  // namespace

void MainWindow::tick() {
  ++ticks_;
  view_->poll();
  if (playback_bar_ != nullptr) playback_bar_->refresh();
  fetchTicks();
  EngineEvent event;
  while (view_->nextEvent(event)) {
    events_->add(event);
    alarms_->add(event);
    newest_event_->setText(engineText(QString::fromUtf8(event.text.data())));
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
    orders_->arm(true);
    orders_->takeOff();
  }
}

void MainWindow::fetchTicks() {
  EngineSnapshot tick;
  while (view_->nextTick(tick)) {
    plots_->addTick(tick);
    calibration_->addTick(tick);
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
  }
  top_bar_->show(snapshot);
  if (engine_ == nullptr) {
    // Nobody flies here.
    top_bar_->armButton()->setEnabled(false);
    top_bar_->takeOffButton()->setEnabled(false);
    top_bar_->landButton()->setEnabled(false);
  }
  menus_->show(snapshot, top_bar_->takeOffButton()->isEnabled(), top_bar_->landButton()->isEnabled());
  const bool pictures = options_.pictures.on && options_.pictures.on();
  menus_->showRecord(snapshot.devices.record.recording && options_.pictures.turn, pictures);
  record_->showRecord(snapshot.devices.record, pictures);
  flight_->show(snapshot);
  attitude_->show(snapshot);
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
