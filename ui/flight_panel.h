#pragma once

#include <QWidget>

#include "engine/pipeline/snapshot.h"

namespace helical {

/// The numbers of the flight, painted as one sheet: state, position against the set-point, motion, sticks,
/// timing. A value the engine does not have is a dash.
class FlightPanel : public QWidget {
  Q_OBJECT

 public:
  explicit FlightPanel(QWidget* parent = nullptr);

  void show(const EngineSnapshot& snapshot);
  QSize sizeHint() const override;
  QSize minimumSizeHint() const override;

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  class Sheet;

  void paintState(Sheet& sheet) const;
  void paintPosition(Sheet& sheet) const;
  void paintMotion(Sheet& sheet) const;
  void paintSticks(Sheet& sheet) const;
  void paintTiming(Sheet& sheet) const;

  EngineSnapshot snapshot_;
  bool filled_ = false;
};

}  // namespace helical
