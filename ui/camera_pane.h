#pragma once

#include <QWidget>

#include "engine/config/rig_config.h"
#include "engine/pipeline/snapshot.h"

class QToolButton;

namespace helical {

class CameraView;
class PanelTitle;

/// One camera: title with name, badge, rate and latency, a button that hides the camera from the tracker, the
/// picture. Shows only what the engine says: the button changes when the engine has obeyed.
class CameraPane : public QWidget {
  Q_OBJECT

 public:
  CameraPane(CameraId camera, const CameraConfig& config, int marker_count, QWidget* parent = nullptr);

  void addTrack(const CameraTrack& track);
  void setPicture(const CameraPicture& picture);
  /// Texts and badge, for a few times a second. `now` is the engine's.
  void setState(const CameraSnapshot& state, TimeNs now);

  bool cameraHidden() const { return hidden_; }
  QToolButton* hideButton() const { return button_; }
  const PanelTitle& title() const { return *title_; }

 Q_SIGNALS:
  void hideRequested(helical::CameraId camera, bool hidden);
  void firstImagePainted();

 private:
  void setBadge(const CameraSnapshot& state);
  void setHidden(bool hidden);

  CameraId camera_;
  QString name_;
  PanelTitle* title_;
  QToolButton* button_;
  CameraView* view_;
  bool hidden_ = false;
};

}  // namespace helical
