#pragma once

#include <QElapsedTimer>
#include <QMainWindow>
#include <QTimer>
#include <array>
#include <functional>
#include <memory>
#include <optional>

#include "engine/pipeline/engine.h"
#include "ui/dock_layouts.h"
#include "ui/orbit_view.h"

class QLabel;

namespace helical {

class AlarmBar;
class AttitudeIndicator;
class CalibrationPanel;
class CameraWall;
class ColourTool;
class EngineOrders;
class EventPanel;
class FlightPanel;
class FlightPlayback;
class MainMenus;
class PanelTitle;
class PlanEditor;
class PlaybackBar;
class PlotDeck;
class RecordLabel;
class SceneView;
class TopBar;
class TuningEditor;
class Viewpoints;

/// The cameras' pictures in the record of a flight; both empty where there is no record.
struct PictureRecord {
  std::function<void(bool on)> turn;
  std::function<bool()> on;
};

struct WindowOptions {
  bool auto_take_off = false;  ///< start the plan as soon as the pose is known
  QString session_folder;      ///< where File > Open session begins
  PictureRecord pictures;      ///< what Ctrl+R turns on and off
  QString layout_file;         ///< where the panels' places are kept from one session to the next; empty: not
};

/// The ground-control window: docks the panels, polls the engine on one timer and hands each panel what it
/// needs. It never waits for the engine.
class MainWindow : public QMainWindow {
  Q_OBJECT

 public:
  /// Can be shown before there is an engine: building both at once saves start-up time.
  MainWindow(const RigConfig& rig, const WindowOptions& options);
  ~MainWindow() override;

  /// From now on shows and commands this engine, which must outlive the window or be detached.
  void attach(Engine& engine);
  /// A recorded flight, which can be looked at alone.
  void attach(FlightPlayback& playback);
  /// Looks on, without anything to command; `attach` begins with it.
  void watch(FlightView& view);
  void detach();

  /// Fills the screen up to 1920x1080.
  void fitToScreen();
  /// The panels as they were when the window was last closed; false if there is nothing to go by.
  bool restoreLayout();
  void arrange(DockLayouts::Layout layout);

  /// From the start of the process to the first camera picture on the screen.
  std::optional<TimeNs> firstImageNs() const { return first_image_; }

  /// How often it has looked at the engine, and shown what has come.
  std::uint64_t refreshes() const { return ticks_; }

  CameraWall& cameras() const { return *cameras_; }
  SceneView& scene() const { return *scene_; }
  PlotDeck& plots() const { return *plots_; }
  CalibrationPanel& calibration() const { return *calibration_; }
  AlarmBar& alarms() const { return *alarms_; }
  EventPanel& events() const { return *events_; }
  ColourTool& colourTool() const { return *colour_tool_; }
  PlanEditor& plan() const { return *plan_; }
  TuningEditor& gains() const { return *gains_; }
  AttitudeIndicator& attitude() const { return *attitude_; }
  TopBar& topBar() const { return *top_bar_; }

 Q_SIGNALS:
  /// File > Open session, or a file dragged onto the window.
  void sessionChosen(const QString& file);
  /// File > Export session: the one that is shown, or one that was asked for.
  void exportChosen(const QString& file);
  /// File > Compare sessions: with the one that is shown, if there is one.
  void comparisonChosen(const QStringList& files);
  /// Flight > Channels of the transmitter, on the ground: whoever owns the engine ends this flight first,
  /// because the device is its.
  void channelsRequested();
  void firstImage(qint64 since_process_start_ns);

 public Q_SLOTS:
  void stop();

 protected:
  void closeEvent(QCloseEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;
  void dragEnterEvent(QDragEnterEvent* event) override;
  void dropEvent(QDropEvent* event) override;

 private:
  void buildPanels();
  void buildFlightPanels();
  void connectCameras();
  QDockWidget* addPanel(PanelTitle* title, QWidget* content, Qt::DockWidgetArea area);
  void buildMenus();
  void buildStatusBar();

  void openManual();
  void chooseSession();
  void chooseExport();
  void chooseComparison();
  void askForChannels();
  void recordPictures(bool on);
  void tick();
  void fetchTicks();
  void fetchPictures();
  void fetchCalibrations();
  void showNumbers(const EngineSnapshot& snapshot);
  void showLoad();
  void noteFirstImage();

  const RigConfig rig_;
  const WindowOptions options_;
  EngineOrders* const orders_;
  FlightView* view_ = nullptr;  ///< what is shown
  Engine* engine_ = nullptr;    ///< the same where it can be commanded
  PlaybackBar* playback_bar_ = nullptr;
  QString session_file_;  ///< of the recorded flight that is shown
  QTimer timer_;
  QElapsedTimer since_load_;
  std::uint64_t ticks_ = 0;
  std::uint64_t ticks_at_load_ = 0;
  int scenes_at_load_ = 0;
  bool took_off_by_itself_ = false;
  std::optional<TimeNs> first_image_;

  TopBar* top_bar_;
  AlarmBar* alarms_;
  CameraWall* cameras_;
  SceneView* scene_;
  PlotDeck* plots_;
  CalibrationPanel* calibration_;
  FlightPanel* flight_;
  EventPanel* events_;
  AttitudeIndicator* attitude_;
  PlanEditor* plan_;
  TuningEditor* gains_;
  DockLayouts::Docks docks_{};
  std::unique_ptr<DockLayouts> layouts_;
  MainMenus* menus_;
  ColourTool* colour_tool_;
  PanelTitle* scene_title_;
  Viewpoints* viewpoints_;
  QLabel* newest_event_;
  RecordLabel* record_;
  QLabel* load_;
};

}  // namespace helical
