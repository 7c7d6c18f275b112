#pragma once

#include <QMenu>

#include "engine/pipeline/snapshot.h"
#include "ui/board_editor.h"

namespace helical {

/// Everything that can be done to one camera, as a menu: for its tools button, a right click on its picture
/// and the menu bar. Ticks show what the engine says, not what was clicked.
class CameraTools : public QMenu {
  Q_OBJECT

 public:
  /// `simulated`: it can be knocked. `images`: noise is counted in grey levels, and there are masks to show.
  CameraTools(const QString& camera_name, bool simulated, bool images, QWidget* parent = nullptr);

  void show(const CameraSnapshot& state);
  /// Those that act on the camera's frames or place, without what only changes the picture.
  const QList<QAction*>& disturbances() const { return disturbances_; }

 Q_SIGNALS:
  void hideRequested(bool hidden);
  void boardToolChosen(helical::BoardEditor::Tool tool);
  void boardsCleared();
  void lossRequested(double share);
  void noiseRequested(double grey_levels, double px);
  void knockRequested(double angle_deg, double distance_m);
  void magnificationChosen(double times);
  void trailsToggled(bool shown);
  void masksToggled(bool background, bool colour);
  void pickRequested();

 private:
  void buildBoards();
  void buildLoss();
  void buildNoise(bool images);
  void buildKnocks();
  void buildPicture(bool images);

  QAction* hide_;
  QList<QAction*> disturbances_;
  QList<QAction*> losses_;
  QList<QAction*> noises_;
};

}  // namespace helical
