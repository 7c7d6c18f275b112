#pragma once

#include <QPoint>
#include <QString>
#include <cstdint>
#include <functional>
#include <vector>

#include "ui/plot_page.h"

class QWidget;

namespace helical {

/// Writes a file by its suffix: png, pdf or csv. False if it cannot be written.
using PlotSaver = std::function<bool(const QString& path)>;

/// A menu at `position` of the screen that saves a plot as picture, page or table, asking for the file. `name` is part
/// of the file's proposed name.
void offerToSave(QWidget* plot, const QPoint& position, const QString& name, const PlotSaver& save);

/// Text, as it is.
bool saveText(const QString& path, const QString& text);

/// A widget as picture, for a path that ends in pdf as page, in csv its `table`.
bool savePlot(QWidget& plot, const QString& path, const std::function<QString()>& table);

/// The lanes' values from one row of the history to before another, one line a tick.
QString tableOf(const std::vector<PlotLane>& lanes, const TickHistory& history, std::int64_t begin, std::int64_t end);

}  // namespace helical
