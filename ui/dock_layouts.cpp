#include "ui/dock_layouts.h"

#include <QDockWidget>
#include <QMainWindow>
#include <QSettings>
#include <algorithm>
#include <array>

namespace helical {
namespace {

constexpr int kVersion = 2;  // another number when panels are added: old places would not fit
constexpr const char* kGeometryKey = "window/geometry";
constexpr const char* kPanelsKey = "window/panels";
constexpr const char* kLightKey = "window/light_theme";
constexpr const char* kLayoutKey = "window/layout";
constexpr int kBars = 110;  // px of height that no panel gets
constexpr int kSideWidth = 296;

}  // namespace

DockLayouts::DockLayouts(QMainWindow& window, const Docks& docks, QString file)
    : window_(window), docks_(docks), file_(std::move(file)) {}

int DockLayouts::camerasWidth(int cameras) const {
  // Three 4:3 pictures above each other fill the height; more cameras get more width.
  const int per_camera = (window_.height() - kBars) / std::clamp(cameras, 1, 3) - 32;
  const int wanted = cameras > 3 ? window_.width() * 2 / 5 : per_camera * 4 / 3;
  return std::clamp(wanted, std::min(360, window_.width() * 23 / 100), window_.width() * 2 / 5);
}

void DockLayouts::arrange(Layout layout, int cameras) {
  layout_ = layout;
  const std::array<std::pair<QDockWidget*, Qt::DockWidgetArea>, 7> places{
      {{docks_.cameras, Qt::LeftDockWidgetArea},
       {docks_.plots, Qt::BottomDockWidgetArea},
       {docks_.flight, Qt::RightDockWidgetArea},
       {docks_.plan, Qt::RightDockWidgetArea},
       {docks_.gains, Qt::RightDockWidgetArea},
       {docks_.calibration, Qt::RightDockWidgetArea},
       {docks_.events, Qt::RightDockWidgetArea}}};
  for (const auto& [dock, area] : places) {
    dock->setFloating(false);
    window_.addDockWidget(area, dock);
    dock->show();
  }
  window_.tabifyDockWidget(docks_.flight, docks_.plan);
  window_.tabifyDockWidget(docks_.plan, docks_.gains);
  docks_.flight->raise();
  if (layout == Layout::kFly)
    arrangeFly(cameras);
  else if (layout == Layout::kCalibrate)
    arrangeCalibrate(cameras);
  else
    arrangeAnalyse();
}

void DockLayouts::arrangeFly(int cameras) {
  const int height = window_.height() - kBars;
  window_.resizeDocks({docks_.cameras, docks_.flight}, {camerasWidth(cameras), kSideWidth}, Qt::Horizontal);
  window_.resizeDocks({docks_.plots}, {window_.height() * 28 / 100}, Qt::Vertical);
  window_.resizeDocks({docks_.flight, docks_.calibration, docks_.events},
                      {height * 58 / 100, height * 24 / 100, height * 18 / 100}, Qt::Vertical);
}

/// The calibration beside large pictures; nothing of the flight but its state.
void DockLayouts::arrangeCalibrate(int cameras) {
  const int height = window_.height() - kBars;
  docks_.plan->hide();
  docks_.gains->hide();
  window_.resizeDocks({docks_.cameras, docks_.calibration},
                      {std::min(window_.width() * 2 / 5, camerasWidth(cameras) * 13 / 10), kSideWidth + 60},
                      Qt::Horizontal);
  window_.resizeDocks({docks_.plots}, {window_.height() * 30 / 100}, Qt::Vertical);
  window_.resizeDocks({docks_.flight, docks_.calibration, docks_.events},
                      {height * 22 / 100, height * 60 / 100, height * 18 / 100}, Qt::Vertical);
}

/// The plots as large as they get.
void DockLayouts::arrangeAnalyse() {
  docks_.flight->hide();
  docks_.plan->hide();
  docks_.gains->hide();
  docks_.calibration->hide();
  window_.resizeDocks({docks_.cameras, docks_.events}, {window_.width() * 15 / 100, kSideWidth},
                      Qt::Horizontal);
  window_.resizeDocks({docks_.plots}, {window_.height() * 60 / 100}, Qt::Vertical);
}

void DockLayouts::save() const {
  if (file_.isEmpty()) return;
  QSettings layout(file_, QSettings::IniFormat);
  layout.setValue(kGeometryKey, window_.saveGeometry());
  layout.setValue(kPanelsKey, window_.saveState(kVersion));
  layout.setValue(kLightKey, light_);
  layout.setValue(kLayoutKey, static_cast<int>(layout_));
}

bool DockLayouts::restore() {
  if (file_.isEmpty()) return false;
  const QSettings layout(file_, QSettings::IniFormat);
  layout_ = static_cast<Layout>(std::clamp(layout.value(kLayoutKey).toInt(), 0, 2));
  light_ = layout.value(kLightKey).toBool();
  return window_.restoreGeometry(layout.value(kGeometryKey).toByteArray()) &&
         window_.restoreState(layout.value(kPanelsKey).toByteArray(), kVersion);
}

}  // namespace helical
