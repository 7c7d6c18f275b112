#pragma once

#include <QWidget>
#include <vector>

#include "engine/config/rig_config.h"
#include "engine/pipeline/white_board.h"

namespace helical {

class CameraPane;

/// All camera panes in a grid whose number of columns makes the pictures as large as the room allows.
class CameraWall : public QWidget {
  Q_OBJECT

 public:
  explicit CameraWall(const RigConfig& rig, QWidget* parent = nullptr);

  int count() const { return static_cast<int>(panes_.size()); }
  CameraPane& pane(int camera) const { return *panes_[static_cast<std::size_t>(camera)]; }

  QSize sizeHint() const override;
  QSize minimumSizeHint() const override;

 Q_SIGNALS:
  void hideRequested(helical::CameraId camera, bool hidden);
  void boardsChanged(helical::CameraId camera, const helical::WhiteBoards& boards);
  void knockRequested(helical::CameraId camera, double angle_deg, double distance_m);
  void lossRequested(helical::CameraId camera, double share);
  void noiseRequested(helical::CameraId camera, double grey_levels, double px);
  void pickRequested();
  void colourPicked(helical::CameraId camera, const Eigen::Vector2d& pixel);
  void firstImagePainted();

 protected:
  void resizeEvent(QResizeEvent* event) override;

 private:
  int bestColumns() const;

  std::vector<CameraPane*> panes_;
};

}  // namespace helical
