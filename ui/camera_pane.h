#pragma once

#include <QWidget>

#include "engine/config/rig_config.h"
#include "engine/pipeline/snapshot.h"
#include "engine/pipeline/white_board.h"

class QAction;
class QToolButton;

namespace helical {

class CameraView;
class PanelTitle;

/// One camera: title with name, badge, rate and latency, buttons that draw a white board before it and hide
/// it from the tracker, the picture. Shows only what the engine says: Hide changes when the engine has
/// obeyed.
class CameraPane : public QWidget {
  Q_OBJECT

 public:
  CameraPane(CameraId camera, const CameraConfig& config, int marker_count, QWidget* parent = nullptr);

  void addTrack(const CameraTrack& track);
  void setPicture(const CameraPicture& picture);
  /// Texts and badge, for a few times a second.
  void setState(const CameraSnapshot& state, const EngineSnapshot& now);

  bool cameraHidden() const { return hidden_; }
  QToolButton* hideButton() const { return button_; }
  QToolButton* boardButton() const { return board_button_; }
  CameraView& view() const { return *view_; }
  /// What can be done to this camera: boards, and in simulation knocks.
  const QList<QAction*>& disturbances() const { return disturbances_; }
  const PanelTitle& title() const { return *title_; }

 Q_SIGNALS:
  void hideRequested(helical::CameraId camera, bool hidden);
  void boardsChanged(helical::CameraId camera, const helical::WhiteBoards& boards);
  void knockRequested(helical::CameraId camera, double angle_deg, double distance_m);
  void firstImagePainted();

 protected:
  void contextMenuEvent(QContextMenuEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;

 private:
  QToolButton* addButton(const QString& text);
  void buildDisturbances(bool simulated);
  QString residualText(const CameraSnapshot& state, const EngineSnapshot& now) const;
  void setBadge(const CameraSnapshot& state);
  void setHidden(bool hidden);

  CameraId camera_;
  QString name_;
  PanelTitle* title_;
  QToolButton* button_;
  QToolButton* board_button_;
  CameraView* view_;
  double focal_length_px_;
  QList<QAction*> disturbances_;
  bool hidden_ = false;
};

}  // namespace helical
