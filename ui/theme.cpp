#include "ui/theme.h"

#include <QApplication>
#include <QPalette>
#include <QStyle>
#include <QStyleFactory>
#include <QWidget>
#include <array>
#include <utility>

namespace helical::theme {
namespace {

constexpr int kLightCamera = 165;  // how much darker cameras' colours are in the light theme

constexpr const char* kStyleSheet = R"(
QMainWindow { background: @background@; }
QMainWindow::separator { background: @background@; width: 6px; height: 6px; }
QMainWindow::separator:hover { background: @on_border@; }
QDockWidget { border: 0; }
QPushButton, QToolButton {
  background: @raised@; border: 1px solid @border@; border-radius: 4px; padding: 4px 12px; color: @text@; }
QPushButton:hover, QToolButton:hover { background: @hover@; border-color: @border_hover@; }
QPushButton:pressed, QToolButton:pressed { background: @pressed@; }
QPushButton:focus, QToolButton:focus { border-color: @active@; }
QPushButton:disabled, QToolButton:disabled { background: @off@; border-color: @edge@; color: @off_text@; }
QToolButton:checked { background: @on@; border-color: @on_border@; color: @on_text@; }
QToolButton#icon { padding: 3px 0; }
QToolButton#small { padding: 1px 8px; border-radius: 3px; }
QPushButton#takeOff:enabled { background: @on@; border-color: @on_border@; color: @on_text@; }
QPushButton#takeOff:enabled:hover { background: @on_hover@; }
QPushButton#stop { background: #b8262b; border-color: #e2474b; color: #ffffff; padding: 4px 22px; }
QPushButton#stop:hover { background: #d02f34; }
QPushButton#stop:pressed { background: #8f1b20; }
QPushButton#stop:focus { border-color: #ffffff; }
QPushButton#acknowledge { background: #ffffff; border-color: #ffffff; color: #7a1216; }
QPushButton#acknowledge:hover { background: #ffe3e4; }
QMenuBar { background: transparent; border: 0; }
QMenuBar::item { padding: 5px 9px; border-radius: 4px; color: @menu_text@; background: transparent; }
QMenuBar::item:selected, QMenuBar::item:pressed { background: @raised@; color: @text@; }
QMenu { background: @title@; border: 1px solid @border@; padding: 4px; }
QMenu::item { padding: 5px 28px 5px 26px; border-radius: 3px; }
QMenu::item:selected { background: @on@; }
QMenu::item:disabled { color: @off_text@; }
QMenu::separator { height: 1px; background: @line@; margin: 4px 8px; }
QStatusBar { background: @bar@; border-top: 1px solid @edge@; color: @muted@; }
QStatusBar::item { border: 0; }
QDialog { background: @title@; border: 1px solid @border@; }
QToolTip { background: @raised@; color: @text@; border: 1px solid @border_hover@; padding: 4px; }
QScrollArea { border: 0; background: @panel@; }
QScrollBar:vertical { background: transparent; width: 9px; margin: 0; }
QScrollBar::handle:vertical { background: @border@; border-radius: 3px; min-height: 24px; margin: 1px 2px; }
QScrollBar::add-line, QScrollBar::sub-line { height: 0; }
QScrollBar::add-page, QScrollBar::sub-page { background: transparent; }
QListView { background: @panel@; border: 0; outline: 0; }
QListView:focus { border: 0; }
#topBar { background: @bar@; border-bottom: 1px solid @edge@; }
#panel { background: @panel@; border: 1px solid @edge@; border-top: 0;
  border-bottom-left-radius: 4px; border-bottom-right-radius: 4px; }
QPushButton#apply:enabled { background: @on@; border-color: @on_border@; color: @on_text@; }
QPushButton#apply:enabled:hover { background: @on_hover@; }
QPushButton#takeOff:disabled, QPushButton#apply:disabled { color: @off_text@; }
QLineEdit, QAbstractSpinBox, QComboBox {
  background: @field@; border: 1px solid @border@; border-radius: 3px; padding: 2px 5px; color: @text@;
  selection-background-color: @on@; }
QLineEdit:focus, QAbstractSpinBox:focus, QComboBox:focus { border-color: @active@; }
QLineEdit:disabled, QAbstractSpinBox:disabled, QComboBox:disabled { color: @off_text@; border-color: @edge@; }
QTableView { background: @panel@; border: 1px solid @edge@; gridline-color: @edge@;
  selection-background-color: @on@; selection-color: @text@; }
QHeaderView { background: @panel@; }
QHeaderView::section { background: @panel@; color: @muted@; border: 0; border-bottom: 1px solid @edge@; padding: 2px; }
QTableCornerButton::section { background: @panel@; border: 0; }
QTabBar::tab { background: @bar@; color: @muted@; border: 1px solid @edge@; border-top: 0; padding: 4px 14px;
  border-bottom-left-radius: 4px; border-bottom-right-radius: 4px; margin-right: 2px; }
QTabBar::tab:selected { background: @raised@; color: @text@; }
QTabBar::tab:hover { color: @text@; }
QToolButton::menu-indicator { image: none; }
)";

struct Shades {
  QColor background, panel, raised, title, line, grid, text, muted, faint, active, healthy, caution, danger;
  /// What only the style sheet uses, by name.
  std::array<std::pair<const char*, const char*>, 14> sheet;
};

const Shades& shadesOf(Theme theme) {
  static const Shades dark{{0x0b, 0x0f, 0x14},
                           {0x10, 0x15, 0x1c},
                           {0x18, 0x20, 0x2a},
                           {0x14, 0x1b, 0x24},
                           {0x23, 0x2c, 0x38},
                           {0x1b, 0x23, 0x2d},
                           {0xd6, 0xde, 0xe7},
                           {0x8a, 0x98, 0xa8},
                           {0x5c, 0x6a, 0x7a},
                           {0x3a, 0xb4, 0xff},
                           {0x3d, 0xdc, 0x84},
                           {0xff, 0xb3, 0x40},
                           {0xff, 0x4d, 0x4f},
                           {{{"border", "#2a3441"},
                             {"bar", "#0e1319"},
                             {"edge", "#1c242e"},
                             {"hover", "#202a36"},
                             {"border_hover", "#3a4756"},
                             {"pressed", "#121921"},
                             {"off", "#10161d"},
                             {"off_text", "#4f5c6a"},
                             {"on", "#12324a"},
                             {"on_border", "#2a7fb5"},
                             {"on_text", "#a6dcff"},
                             {"on_hover", "#17405e"},
                             {"menu_text", "#a9b6c4"},
                             {"field", "#0c1117"}}}};
  static const Shades light{{0xdd, 0xe2, 0xe8},
                            {0xfa, 0xfb, 0xfc},
                            {0xec, 0xef, 0xf3},
                            {0xe6, 0xea, 0xef},
                            {0xc6, 0xce, 0xd8},
                            {0xdf, 0xe4, 0xea},
                            {0x18, 0x20, 0x2a},
                            {0x52, 0x60, 0x70},
                            {0x7d, 0x8a, 0x99},
                            {0x0a, 0x74, 0xc4},
                            {0x0d, 0x86, 0x48},
                            {0xb2, 0x66, 0x00},
                            {0xc8, 0x1e, 0x24},
                            {{{"border", "#b9c3ce"},
                              {"bar", "#f1f4f7"},
                              {"edge", "#cfd6de"},
                              {"hover", "#ffffff"},
                              {"border_hover", "#93a1b0"},
                              {"pressed", "#d8dee5"},
                              {"off", "#eef1f4"},
                              {"off_text", "#9aa6b3"},
                              {"on", "#cfe6f7"},
                              {"on_border", "#3f97d3"},
                              {"on_text", "#084b7d"},
                              {"on_hover", "#bcdcf3"},
                              {"menu_text", "#3b4856"},
                              {"field", "#ffffff"}}}};
  return theme == Theme::kLight ? light : dark;
}

/// The window's colours in the order of Shades, as others see them.
std::array<QColor*, 13> shown() {
  return {&kBackground, &kPanel, &kRaised, &kTitle,   &kLine,    &kGrid,  &kText,
          &kMuted,      &kFaint, &kActive, &kHealthy, &kCaution, &kDanger};
}

std::array<QColor, 13> listOf(const Shades& s) {
  return {s.background, s.panel, s.raised, s.title,   s.line,    s.grid,  s.text,
          s.muted,      s.faint, s.active, s.healthy, s.caution, s.danger};
}

QString styleSheet(const Shades& shades) {
  QString sheet = QString::fromLatin1(kStyleSheet);
  for (const auto& [name, value] : shades.sheet)
    sheet.replace(QStringLiteral("@%1@").arg(QLatin1String(name)), QLatin1String(value));
  const std::pair<const char*, QColor> shared[] = {
      {"background", shades.background}, {"panel", shades.panel}, {"raised", shades.raised},
      {"title", shades.title},           {"line", shades.line},   {"text", shades.text},
      {"muted", shades.muted},           {"faint", shades.faint}, {"active", shades.active}};
  for (const auto& [name, value] : shared)
    sheet.replace(QStringLiteral("@%1@").arg(QLatin1String(name)), value.name());
  return sheet;
}

Theme current = Theme::kDark;

QPalette palette() {
  QPalette p;
  p.setColor(QPalette::Window, kBackground);
  p.setColor(QPalette::Base, kPanel);
  p.setColor(QPalette::AlternateBase, kRaised);
  p.setColor(QPalette::Button, kRaised);
  p.setColor(QPalette::ToolTipBase, kRaised);
  for (const auto role :
       {QPalette::WindowText, QPalette::Text, QPalette::ButtonText, QPalette::ToolTipText}) {
    p.setColor(role, kText);
    p.setColor(QPalette::Disabled, role, kFaint);
  }
  p.setColor(QPalette::BrightText, kDanger);
  p.setColor(QPalette::Highlight,
             current == Theme::kLight ? QColor(0xbc, 0xdc, 0xf3) : QColor(0x1b, 0x4a, 0x6c));
  p.setColor(QPalette::HighlightedText, kText);
  p.setColor(QPalette::Link, kActive);
  p.setColor(QPalette::PlaceholderText, kMuted);
  p.setColor(QPalette::Light, kLine);
  p.setColor(QPalette::Midlight, kLine);
  p.setColor(QPalette::Mid, kLine);
  p.setColor(QPalette::Dark, kBackground);
  p.setColor(QPalette::Shadow, Qt::black);
  return p;
}

}  // namespace

QColor on_dark::cameraColor(int index) {
  // No green, amber-red or red among them: those mean something.
  static const std::array<QColor, 8> colors{
      QColor(0x4d, 0xc2, 0xff), QColor(0xff, 0xb2, 0x47), QColor(0xc6, 0x8c, 0xff), QColor(0x55, 0xe0, 0xcf),
      QColor(0xff, 0x9a, 0xd5), QColor(0x9f, 0xb0, 0xff), QColor(0xe0, 0xd0, 0x74), QColor(0xc9, 0xb2, 0xa2)};
  return colors[static_cast<std::size_t>(index) % colors.size()];
}

QColor cameraColor(int index) {
  const QColor color = on_dark::cameraColor(index);
  return current == Theme::kLight ? color.darker(kLightCamera) : color;
}

QFont uiFont(double points, QFont::Weight weight) {
  QFont font(QStringList{"Inter", "Noto Sans", "DejaVu Sans"});
  font.setPointSizeF(points);
  font.setWeight(weight);
  return font;
}

QFont monoFont(double points, QFont::Weight weight) {
  QFont font(QStringList{"JetBrains Mono", "DejaVu Sans Mono"});
  font.setPointSizeF(points);
  font.setWeight(weight);
  font.setStyleHint(QFont::Monospace);
  return font;
}

QFont capsFont(double points, QFont::Weight weight) {
  QFont font = uiFont(points, weight);
  font.setCapitalization(QFont::AllUppercase);
  font.setLetterSpacing(QFont::AbsoluteSpacing, 0.8);
  return font;
}

QColor translated(const QColor& color) {
  const Theme other = current == Theme::kLight ? Theme::kDark : Theme::kLight;
  const std::array<QColor, 13> before = listOf(shadesOf(other)), now = listOf(shadesOf(current));
  QColor result = color;
  const auto try_one = [&](const QColor& from, const QColor& to) {
    if (color.rgb() == from.rgb()) result = to;
  };
  for (std::size_t i = 0; i < before.size(); ++i) try_one(before[i], now[i]);
  for (int i = 0; i < 8; ++i) {
    const QColor dark = on_dark::cameraColor(i), light = dark.darker(kLightCamera);
    try_one(current == Theme::kLight ? dark : light, current == Theme::kLight ? light : dark);
  }
  result.setAlpha(color.alpha());
  return result;
}

void apply(QApplication& application, Theme theme) {
  current = theme;
  const std::array<QColor, 13> now = listOf(shadesOf(theme));
  for (std::size_t i = 0; i < now.size(); ++i) *shown()[i] = now[i];
  if (QApplication::style()->name() != QLatin1String("fusion"))
    QApplication::setStyle(QStyleFactory::create("Fusion"));
  QApplication::setFont(uiFont(9));
  QApplication::setPalette(palette());
  application.setStyleSheet(styleSheet(shadesOf(theme)));
  for (QWidget* widget : QApplication::allWidgets()) {
    if (!widget->testAttribute(Qt::WA_SetPalette)) continue;
    QPalette own = widget->palette();
    own.setColor(QPalette::WindowText, translated(own.color(QPalette::WindowText)));
    widget->setPalette(own);
  }
}

void setTextColor(QWidget& widget, const QColor& color) {
  QPalette palette = widget.palette();
  if (widget.testAttribute(Qt::WA_SetPalette) && palette.color(QPalette::WindowText) == color) return;
  palette.setColor(QPalette::WindowText, color);
  widget.setPalette(palette);
}

Theme theme() {
  return current;
}

}  // namespace helical::theme
