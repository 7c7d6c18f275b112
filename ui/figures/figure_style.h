#pragma once

#include <QColor>

namespace helical::figures {

/// Colours and lengths of the figures. Lengths in mm on paper: a column of the paper is 85 mm wide.

inline const QColor kInk{0x1a, 0x1a, 0x1a};
inline const QColor kQuietInk{0x70, 0x70, 0x70};
inline const QColor kCoveredShade{0xe9, 0xe9, 0xe9};
/// Orange and dark blue: told apart by every kind of colour vision, and by their greys in print (139 and 63
/// of 255).
inline const QColor kExperimentA{0xe0, 0x7b, 0x00};
inline const QColor kExperimentB{0x00, 0x4d, 0x99};

inline constexpr double kFigureWidth = 85.0;
inline constexpr double kMargin = 1.5;
inline constexpr double kLeftMargin = 13.0;   ///< title and tick labels of the y axis
inline constexpr double kBottomMargin = 7.8;  ///< title and tick labels of the time axis
inline constexpr double kBetweenPanels = 2.5;
inline constexpr double kCurvesHeight = 36.0;
inline constexpr double kRasterHeight = 46.0;
inline constexpr double kRasterHeightPerCamera = 5.0;  ///< at least: its name stands beside it

inline constexpr double kFontSize = 2.5;  ///< about 7 pt
inline constexpr double kRowHeight = 3.7;
inline constexpr double kFrameWidth = 0.15;
inline constexpr double kReferenceWidth = 0.22;
inline constexpr double kCurveWidth = 0.32;
inline constexpr double kErrorWidth = 0.22;  ///< six curves in one plot
inline constexpr double kTickLength = 0.9;
inline constexpr double kExitMarkWidth = 1.8;
inline constexpr double kLegendKeyLength = 5.2;
inline constexpr double kLegendGap = 2.4;
inline constexpr double kBraceWidth = 1.8;
inline constexpr double kBarHeight = 0.55;  ///< of a row of the raster

}  // namespace helical::figures
