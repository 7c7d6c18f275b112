#pragma once

#include <QImage>
#include <filesystem>

#include "ui/figures/figure.h"

namespace helical::figures {

/// The figure at 300 dpi, 1004 pixels wide. Needs a QGuiApplication; one thread at a time.
QImage paintFigure(const Figure& figure);

/// Write `folder`/STEM.png and `folder`/STEM.pdf and return their names. A file appears whole or not at
/// all. The PDF is of lines and letters, no picture, one page of the figure's size; both carry the figure's
/// title and say "Helical". Throws `Error` with the file and a cure. Needs a QGuiApplication; one thread at a
/// time.
std::filesystem::path writePng(const Figure& figure, const std::filesystem::path& folder);
std::filesystem::path writePdf(const Figure& figure, const std::filesystem::path& folder);
std::vector<std::filesystem::path> writeFigure(const Figure& figure, const std::filesystem::path& folder);

}  // namespace helical::figures
