#include "ui/key_sheet.h"

#include <QGridLayout>
#include <QLabel>

#include "ui/theme.h"

namespace helical {
namespace {

QLabel* makeLabel(const QString& text, const QFont& font) {
  auto* label = new QLabel(text);
  label->setFont(font);
  return label;
}

}  // namespace

KeySheet::KeySheet(QWidget* parent) : QDialog(parent) {
  setWindowTitle(tr("Keys and mouse"));
  setAccessibleName(windowTitle());
  auto* grid = new QGridLayout(this);
  grid->setContentsMargins(24, 16, 24, 20);
  grid->setHorizontalSpacing(22);
  grid->setVerticalSpacing(5);
  const auto heading = [&](const QString& text) {
    QLabel* label = makeLabel(text, theme::capsFont(7.4));
    label->setContentsMargins(0, grid->rowCount() > 1 ? 12 : 0, 0, 2);
    label->setForegroundRole(QPalette::PlaceholderText);
    grid->addWidget(label, grid->rowCount(), 0, 1, 2);
  };
  const auto add = [&](const QString& key, const QString& what) {
    const int row = grid->rowCount();
    grid->addWidget(makeLabel(key, theme::monoFont(9, QFont::DemiBold)), row, 0, Qt::AlignTop);
    grid->addWidget(makeLabel(what, theme::uiFont(9.2)), row, 1);
  };
  heading(tr("Flight"));
  add(tr("Esc"), tr("STOP: rotors off at once, whatever has the focus"));
  add(tr("Tab to Arm, hold Space"), tr("arm: hold the key or the button down for a second"));
  heading(tr("Window"));
  add(QStringLiteral("1 \u2026 9"), tr("hide or show a camera"));
  add(tr("Space"), tr("hold the plots still, or follow again"));
  add(tr("Ctrl+R"), tr("record the cameras' pictures, or no more"));
  add(QStringLiteral("F1"), tr("this sheet"));
  add(tr("Ctrl+F1"), tr("the manual"));
  add(QStringLiteral("F11"), tr("full screen"));
  add(tr("Tab"), tr("next control; Space presses it"));
  add(tr("Ctrl+Q"), tr("quit"));
  heading(tr("Camera pictures"));
  add(tr("Wheel"), tr("zoom where the mouse is"));
  add(tr("Drag"), tr("move the zoomed picture, or a white board"));
  add(tr("Double click"), tr("the whole picture again"));
  add(tr("Right click"), tr("boards, lost frames, noise, knocks, masks, trails"));
  heading(tr("3D scene"));
  add(tr("Drag"), tr("turn"));
  add(tr("Right drag, or Shift and drag"), tr("move"));
  add(tr("Wheel"), tr("zoom"));
  heading(tr("Plots"));
  add(tr("Drag, wheel"), tr("scroll back, zoom the time"));
  add(tr("Double click"), tr("back to now"));
  add(tr("Right click"), tr("save as PNG, PDF or CSV"));
}

}  // namespace helical
