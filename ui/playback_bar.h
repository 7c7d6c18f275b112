#pragma once

#include <QWidget>

#include "engine/session/flight_playback.h"

class QComboBox;
class QLabel;
class QToolButton;

namespace helical {

class PlaybackTimeLine;

/// Plays a recorded flight: play and pause, a tick back and forth, 0.1 to 10 times its pace, a loop between A
/// and B, and the time line with the flight's events to drag over. Space plays and pauses, the arrows step.
class PlaybackBar : public QWidget {
  Q_OBJECT

 public:
  /// `playback` must outlive this.
  explicit PlaybackBar(FlightPlayback& playback, QWidget* parent = nullptr);

  /// After each move of the playback.
  void refresh();

  PlaybackTimeLine& timeLine() const { return *time_line_; }
  QToolButton* playButton() const { return play_; }

 private:
  QToolButton* addButton(const QString& text, const QString& tip, const QKeySequence& key);
  void togglePlay();
  void setMark(bool begin);

  FlightPlayback& playback_;
  PlaybackTimeLine* time_line_;
  QToolButton* play_;
  QToolButton* mark_a_;
  QToolButton* mark_b_;
  QComboBox* speed_;
  QLabel* time_;
};

}  // namespace helical
