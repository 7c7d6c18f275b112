#pragma once

#include <QPointF>
#include <QString>

class QPainter;

namespace helical::figures {

/// Width of the figures' text [mm]. Like all of them: needs a QGuiApplication, one thread at a time.
double textWidth(const QString& text);

/// Draws text in the painter's pen, whose unit is 1 mm. `anchor` is the point of the text that `alignment`
/// names; vertically top and bottom mean those of a capital letter, so that words on a line agree.
void drawText(QPainter& painter, const QPointF& anchor, Qt::Alignment alignment, const QString& text);

/// The same, reading upwards, centred on `anchor`.
void drawTextUpwards(QPainter& painter, const QPointF& anchor, const QString& text);

}  // namespace helical::figures
