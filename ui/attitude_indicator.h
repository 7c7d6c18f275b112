#pragma once

#include <QWidget>

#include "engine/pipeline/snapshot.h"

namespace helical {

/// Artificial horizon: sky, ground, pitch ladder, bank scale, heading tape. Empty without a pose.
class AttitudeIndicator : public QWidget {
  Q_OBJECT

 public:
  explicit AttitudeIndicator(QWidget* parent = nullptr);

  void show(const EngineSnapshot& snapshot);
  QSize sizeHint() const override { return {250, 150}; }
  QSize minimumSizeHint() const override { return {200, 140}; }

  double rollDeg() const { return roll_deg_; }    ///< right side down is positive
  double pitchDeg() const { return pitch_deg_; }  ///< nose up is positive
  double yawDeg() const { return yaw_deg_; }      ///< to the left is positive, as in the world frame
  bool known() const { return known_; }

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  void paintBall(QPainter& painter, const QPointF& center, double radius) const;
  void paintBank(QPainter& painter, const QPointF& center, double radius) const;
  void paintNumbers(QPainter& painter) const;

  bool known_ = false;
  double roll_deg_ = 0.0;
  double pitch_deg_ = 0.0;
  double yaw_deg_ = 0.0;
};

}  // namespace helical
