#pragma once

#include <QColor>
#include <QFont>

class QApplication;

namespace helical::theme {

/// The window's colours and fonts. Blue is active, green healthy, amber caution; red is danger and nothing
/// else.
inline const QColor kBackground{0x0b, 0x0f, 0x14};
inline const QColor kPanel{0x10, 0x15, 0x1c};
inline const QColor kRaised{0x18, 0x20, 0x2a};
inline const QColor kTitle{0x14, 0x1b, 0x24};
inline const QColor kLine{0x23, 0x2c, 0x38};
inline const QColor kGrid{0x1b, 0x23, 0x2d};
inline const QColor kText{0xd6, 0xde, 0xe7};
inline const QColor kMuted{0x8a, 0x98, 0xa8};
inline const QColor kFaint{0x5c, 0x6a, 0x7a};
inline const QColor kActive{0x3a, 0xb4, 0xff};
inline const QColor kHealthy{0x3d, 0xdc, 0x84};
inline const QColor kCaution{0xff, 0xb3, 0x40};
inline const QColor kDanger{0xff, 0x4d, 0x4f};

/// The identity colour of a camera, shared by its title, brackets, frustum and rays. Repeats after eight.
QColor cameraColor(int index);

QFont uiFont(double points, QFont::Weight weight = QFont::Normal);
QFont monoFont(double points, QFont::Weight weight = QFont::Normal);  ///< for numbers that change
QFont capsFont(double points,
               QFont::Weight weight = QFont::DemiBold);  ///< small tracked capitals, for titles

/// Sets style, palette, font and style sheet of the whole application. Once, before the first widget.
void apply(QApplication& application);

}  // namespace helical::theme
