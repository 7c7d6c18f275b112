#pragma once

#include <QString>

class QToolButton;

namespace helical {

/// A button as small as a line of text, for titles and panels, reached by Tab. `name` is for those who do not see it.
/// After setDefaultAction, which brings its own font.
void makeSmall(QToolButton& button, const QString& name);
QToolButton* smallButton(const QString& text, const QString& name, const QString& tip);

}  // namespace helical
