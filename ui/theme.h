#pragma once

#include <QColor>
#include <QFont>

class QApplication;
class QWidget;

namespace helical::theme {

/// The window's colours and fonts; those of the dark theme until `apply` says otherwise. Blue is active,
/// green healthy, amber caution; red is danger and nothing else. Window thread: who draws elsewhere keeps a
/// copy.
inline QColor kBackground{0x0b, 0x0f, 0x14};
inline QColor kPanel{0x10, 0x15, 0x1c};
inline QColor kRaised{0x18, 0x20, 0x2a};
inline QColor kTitle{0x14, 0x1b, 0x24};
inline QColor kLine{0x23, 0x2c, 0x38};
inline QColor kGrid{0x1b, 0x23, 0x2d};
inline QColor kText{0xd6, 0xde, 0xe7};
inline QColor kMuted{0x8a, 0x98, 0xa8};
inline QColor kFaint{0x5c, 0x6a, 0x7a};
inline QColor kActive{0x3a, 0xb4, 0xff};
inline QColor kHealthy{0x3d, 0xdc, 0x84};
inline QColor kCaution{0xff, 0xb3, 0x40};
inline QColor kDanger{0xff, 0x4d, 0x4f};

/// The same on pictures and in the 3D scene, which are dark in every theme. Any thread.
namespace on_dark {
inline const QColor kText{0xd6, 0xde, 0xe7};
inline const QColor kMuted{0x8a, 0x98, 0xa8};
inline const QColor kActive{0x3a, 0xb4, 0xff};
inline const QColor kHealthy{0x3d, 0xdc, 0x84};
inline const QColor kCaution{0xff, 0xb3, 0x40};
QColor cameraColor(int index);
}  // namespace on_dark

/// The identity colour of a camera, shared by its title, brackets, frustum and rays. Repeats after eight.
QColor cameraColor(int index);

QFont uiFont(double points, QFont::Weight weight = QFont::Normal);
QFont monoFont(double points, QFont::Weight weight = QFont::Normal);  ///< for numbers that change
QFont capsFont(double points,
               QFont::Weight weight = QFont::DemiBold);  ///< small tracked capitals, for titles

enum class Theme { kDark, kLight };

/// Sets style, palette, font, style sheet and the colours above for the whole application; widgets that are
/// there already take the new ones at their next painting.
void apply(QApplication& application, Theme theme = Theme::kDark);
Theme theme();
void setTextColor(QWidget& widget, const QColor& color);
/// A colour of the theme before, as it is in this one; any other colour as it is. For colours that somebody
/// keeps: call it upon QEvent::PaletteChange.
QColor translated(const QColor& color);

}  // namespace helical::theme
