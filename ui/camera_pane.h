#pragma once

#include <QWidget>

#include "engine/config/rig_config.h"
#include "engine/pipeline/snapshot.h"
#include "engine/pipeline/white_board.h"

class QToolButton;

namespace helical {

class CameraTools;
class CameraView;
class PanelTitle;

/// One camera: title with name, badge, rate and latency, buttons that draw a white board before it and hide
/// it from the tracker, the picture. Shows only what the engine says: Hide changes when the engine has
/// obeyed.
class CameraPane : public QWidget {
  Q_OBJECT

 public:
  CameraPane(CameraId camera, const RigConfig& rig, QWidget* parent = nullptr);

  void addTrack(const CameraTrack& track);
  void setPicture(const CameraPicture& picture);
  /// Texts and badge, for a few times a second.
  void setState(const CameraSnapshot& state, const EngineSnapshot& now);

  /// Shows what a colour range would find; with `picking` a click names a marker.
  void previewColour(const ColourRange& range, bool picking);

  bool cameraHidden() const { return hidden_; }
  QToolButton* hideButton() const { return button_; }
  QToolButton* boardButton() const { return board_button_; }
  CameraView& view() const { return *view_; }
  CameraTools& tools() const { return *tools_; }
  QToolButton* toolsButton() const { return tools_button_; }
  const PanelTitle& title() const { return *title_; }

 Q_SIGNALS:
  void hideRequested(helical::CameraId camera, bool hidden);
  void boardsChanged(helical::CameraId camera, const helical::WhiteBoards& boards);
  void knockRequested(helical::CameraId camera, double angle_deg, double distance_m);
  void lossRequested(helical::CameraId camera, double share);
  void noiseRequested(helical::CameraId camera, double grey_levels, double px);
  /// Somebody wants to choose the markers' colour, or has clicked one.
  void pickRequested();
  void colourPicked(helical::CameraId camera, const Eigen::Vector2d& pixel);
  void firstImagePainted();

 protected:
  void contextMenuEvent(QContextMenuEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;

 private:
  QToolButton* addButton(const QString& text);
  void buildTools(const CameraConfig& config, bool images);
  void connectTools();
  QString residualText(const CameraSnapshot& state, const EngineSnapshot& now) const;
  void setBadge(const CameraSnapshot& state);
  void setHidden(bool hidden);

  CameraId camera_;
  QStringList names_;  ///< of all cameras
  QString name_;
  PanelTitle* title_;
  QToolButton* button_;
  QToolButton* board_button_;
  QToolButton* tools_button_;
  CameraTools* tools_;
  CameraView* view_;
  double focal_length_px_;
  bool hidden_ = false;
  bool colour_mask_ = false;  ///< asked for; the preview of a colour shows it, too
};

}  // namespace helical
