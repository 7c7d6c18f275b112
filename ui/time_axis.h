#pragma once

#include <QObject>

namespace helical {

/// The one time axis of all plots [s of the engine]: it follows the newest tick, or stands where somebody
/// scrolled to while the flight goes on.
class TimeAxis : public QObject {
  Q_OBJECT

 public:
  using QObject::QObject;

  static constexpr double kShortest = 2.0;
  static constexpr double kLongest = 1200.0;

  /// The newest tick is at `now`, the oldest kept one at `oldest`.
  void advance(double oldest, double now);

  bool live() const { return live_; }
  double begin() const { return end_ - span_; }
  double end() const { return end_; }

  void setLive(bool live);
  void scroll(double seconds);  ///< stops following; back at the newest tick it follows again
  void zoom(double factor, double about);

 Q_SIGNALS:
  void liveChanged(bool live);
  void changed();  ///< by hand, not by time

 private:
  void place(double end);

  bool live_ = true;
  double span_ = 30.0;
  double end_ = 30.0;
  double oldest_ = 0.0;
  double now_ = 0.0;
};

}  // namespace helical
