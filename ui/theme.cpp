#include "ui/theme.h"

#include <QApplication>
#include <QPalette>
#include <QStyleFactory>
#include <array>

namespace helical::theme {
namespace {

constexpr const char* kStyleSheet = R"(
QMainWindow { background: #0b0f14; }
QMainWindow::separator { background: #0b0f14; width: 6px; height: 6px; }
QMainWindow::separator:hover { background: #2a7fb5; }
QDockWidget { border: 0; }
QPushButton, QToolButton {
  background: #18202a; border: 1px solid #2a3441; border-radius: 4px; padding: 4px 12px; color: #d6dee7; }
QPushButton:hover, QToolButton:hover { background: #202a36; border-color: #3a4756; }
QPushButton:pressed, QToolButton:pressed { background: #121921; }
QPushButton:focus, QToolButton:focus { border-color: #3ab4ff; }
QPushButton:disabled, QToolButton:disabled { background: #10161d; border-color: #1c242e; color: #4f5c6a; }
QToolButton:checked { background: #12324a; border-color: #2a7fb5; color: #a6dcff; }
QToolButton#small { padding: 1px 8px; border-radius: 3px; }
QPushButton#takeOff:enabled { background: #12324a; border-color: #2a7fb5; color: #a6dcff; }
QPushButton#takeOff:enabled:hover { background: #17405e; }
QPushButton#stop { background: #b8262b; border-color: #e2474b; color: #ffffff; padding: 4px 22px; }
QPushButton#stop:hover { background: #d02f34; }
QPushButton#stop:pressed { background: #8f1b20; }
QPushButton#stop:focus { border-color: #ffffff; }
QPushButton#acknowledge { background: #ffffff; border-color: #ffffff; color: #7a1216; }
QPushButton#acknowledge:hover { background: #ffe3e4; }
QMenuBar { background: transparent; border: 0; }
QMenuBar::item { padding: 5px 9px; border-radius: 4px; color: #a9b6c4; background: transparent; }
QMenuBar::item:selected, QMenuBar::item:pressed { background: #18202a; color: #d6dee7; }
QMenu { background: #141b24; border: 1px solid #2a3441; padding: 4px; }
QMenu::item { padding: 5px 28px 5px 26px; border-radius: 3px; }
QMenu::item:selected { background: #12324a; }
QMenu::item:disabled { color: #4f5c6a; }
QMenu::separator { height: 1px; background: #232c38; margin: 4px 8px; }
QStatusBar { background: #0e1319; border-top: 1px solid #1c242e; color: #8a98a8; }
QStatusBar::item { border: 0; }
QDialog { background: #141b24; border: 1px solid #2a3441; }
QToolTip { background: #18202a; color: #d6dee7; border: 1px solid #33404f; padding: 4px; }
QScrollArea { border: 0; background: #10151c; }
QScrollBar:vertical { background: transparent; width: 9px; margin: 0; }
QScrollBar::handle:vertical { background: #2a3441; border-radius: 3px; min-height: 24px; margin: 1px 2px; }
QScrollBar::add-line, QScrollBar::sub-line { height: 0; }
QScrollBar::add-page, QScrollBar::sub-page { background: transparent; }
QListView { background: #10151c; border: 0; outline: 0; }
QListView:focus { border: 0; }
#topBar { background: #0e1319; border-bottom: 1px solid #1c242e; }
#panel { background: #10151c; border: 1px solid #1f2833; border-top: 0;
  border-bottom-left-radius: 4px; border-bottom-right-radius: 4px; }
)";

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
  p.setColor(QPalette::Highlight, QColor(0x1b, 0x4a, 0x6c));
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

QColor cameraColor(int index) {
  // No green, amber-red or red among them: those mean something.
  static const std::array<QColor, 8> colors{
      QColor(0x4d, 0xc2, 0xff), QColor(0xff, 0xb2, 0x47), QColor(0xc6, 0x8c, 0xff), QColor(0x55, 0xe0, 0xcf),
      QColor(0xff, 0x9a, 0xd5), QColor(0x9f, 0xb0, 0xff), QColor(0xe0, 0xd0, 0x74), QColor(0xc9, 0xb2, 0xa2)};
  return colors[static_cast<std::size_t>(index) % colors.size()];
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

void apply(QApplication& application) {
  QApplication::setStyle(QStyleFactory::create("Fusion"));
  QApplication::setFont(uiFont(9));
  QApplication::setPalette(palette());
  application.setStyleSheet(kStyleSheet);
}

}  // namespace helical::theme
