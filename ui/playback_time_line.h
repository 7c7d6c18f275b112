#pragma once

#include <QWidget>

#include "engine/session/flight_playback.h"

namespace helical {

/// "3:07.50": minutes and seconds since the flight's begin.
QString playbackTime(TimeNs since_begin);

/// The flight from its begin to its end: where the playback stands, the loop, a tick for each event. Press
/// and drag to go there; the pointer over an event reads it.
class PlaybackTimeLine : public QWidget {
  Q_OBJECT

 public:
  explicit PlaybackTimeLine(FlightPlayback& playback, QWidget* parent = nullptr);

  QSize sizeHint() const override { return {400, 34}; }
  TimeNs timeAt(double x) const;
  double xOf(TimeNs time) const;

 protected:
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  bool event(QEvent* event) override;

 private:
  FlightPlayback& playback_;
};

}  // namespace helical
