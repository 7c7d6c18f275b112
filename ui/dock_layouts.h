#pragma once

#include <QString>

class QDockWidget;
class QMainWindow;

namespace helical {

/// Where the panels stand: three layouts for three kinds of work, and what the user made of them, kept in a
/// file from one session to the next.
class DockLayouts {
 public:
  enum class Layout { kFly, kCalibrate, kAnalyse };

  struct Docks {
    QDockWidget* cameras;
    QDockWidget* plots;
    QDockWidget* flight;
    QDockWidget* plan;
    QDockWidget* gains;
    QDockWidget* calibration;
    QDockWidget* events;
  };

  /// `file` may be empty: nothing is kept.
  DockLayouts(QMainWindow& window, const Docks& docks, QString file);

  void arrange(Layout layout, int cameras);
  Layout layout() const { return layout_; }
  /// Places, sizes and which layout it began with.
  void save() const;
  /// The light theme, kept with the rest.
  void setLight(bool on) { light_ = on; }
  bool light() const { return light_; }
  /// False if there is nothing sensible to go by.
  bool restore();

 private:
  void arrangeFly(int cameras);
  void arrangeCalibrate(int cameras);
  void arrangeAnalyse();
  int camerasWidth(int cameras) const;

  QMainWindow& window_;
  Docks docks_;
  QString file_;
  Layout layout_ = Layout::kFly;
  bool light_ = false;
};

}  // namespace helical
