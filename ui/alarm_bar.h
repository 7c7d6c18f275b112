#pragma once

#include <QHash>
#include <QWidget>
#include <deque>

#include "engine/pipeline/snapshot.h"

class QPushButton;

namespace helical {

/// Dangers that nobody has acknowledged yet, the newest in red over the window, with a sound. The same danger
/// does not come back within half a minute of the engine's time.
class AlarmBar : public QWidget {
  Q_OBJECT

 public:
  explicit AlarmBar(QWidget* parent);

  /// Events of less than danger are none of its business.
  void add(const EngineEvent& event);
  void acknowledge();

  int unacknowledged() const { return static_cast<int>(alarms_.size()); }
  QString text() const;
  QPushButton* acknowledgeButton() const { return button_; }
  /// Takes its place: centred below `top` of the parent.
  void place(int top);

  /// Whether an alarm is heard.
  void setSound(bool on) { sound_ = on; }

  static constexpr TimeNs kSilence = 30 * kNanosecondsPerSecond;

 Q_SIGNALS:
  void acknowledged();

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  struct Alarm {
    TimeNs time;
    QString text;
  };

  std::deque<Alarm> alarms_;
  QHash<QString, TimeNs> last_raised_;
  QPushButton* button_;
  bool sound_ = true;
};

}  // namespace helical
