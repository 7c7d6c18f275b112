#pragma once

#include <QList>
#include <QObject>
#include <vector>

#include "engine/config/rig_config.h"
#include "engine/pipeline/snapshot.h"
#include "ui/dock_layouts.h"

class QAction;
class QDockWidget;
class QMainWindow;
class QMenu;
class QMenuBar;

namespace helical {

class CameraWall;
class PlotDeck;
class SceneView;

/// The menus of the window. They ask; what they show as on is what the engine or the panel says.
class MainMenus : public QObject {
  Q_OBJECT

 public:
  struct Panels {
    CameraWall& cameras;
    SceneView& scene;
    PlotDeck& plots;
    QList<QAction*> viewpoints;
    QList<QDockWidget*> docks;
  };

  /// `window` gets the shortcuts.
  MainMenus(const RigConfig& rig, const Panels& panels, QMenuBar& bar, QMainWindow& window);

  void setLight(bool on);
  void show(const EngineSnapshot& snapshot, bool can_take_off, bool can_land);
  /// Whether the flight is recorded, and pictures with it.
  void showRecord(bool recorded, bool pictures);

 Q_SIGNALS:
  void openRequested();
  void exportRequested();
  void compareRequested();
  void picturesRequested(bool on);
  void takeOffRequested();
  void landRequested();
  void stopRequested();
  void channelsRequested();
  void hideRequested(helical::CameraId camera, bool hidden);
  void backgroundRequested();
  void colourRequested();
  void gustRequested(double speed);
  void layoutRequested(helical::DockLayouts::Layout layout);
  void soundToggled(bool on);
  void lightToggled(bool on);
  void manualRequested();
  void keysRequested();
  void aboutRequested();

 private:
  void buildFlight(QMenu& menu);
  void buildCameras(QMenu& menu);
  void buildDisturb(QMenu& menu);
  void buildView(QMenu& menu);
  void buildPanels(QMenu& menu);

  const RigConfig& rig_;
  Panels panels_;
  QMainWindow& window_;
  QAction* pictures_ = nullptr;
  QAction* take_off_ = nullptr;
  QAction* land_ = nullptr;
  QAction* channels_ = nullptr;  ///< null: the transmitter has none
  QAction* background_ = nullptr;
  QAction* light_ = nullptr;
  std::vector<QAction*> hide_;
};

}  // namespace helical
