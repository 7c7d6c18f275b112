#include "ui/small_button.h"

#include <QToolButton>

#include "ui/theme.h"

namespace helical {

void makeSmall(QToolButton& button, const QString& name) {
  button.setObjectName(QStringLiteral("small"));
  button.setFont(theme::uiFont(8, QFont::Medium));
  button.setFixedHeight(19);
  button.setFocusPolicy(Qt::TabFocus);
  button.setAccessibleName(name);
}

QToolButton* smallButton(const QString& text, const QString& name, const QString& tip) {
  auto* button = new QToolButton;
  makeSmall(*button, name);
  button->setText(text);
  button->setToolTip(tip);
  return button;
}

}  // namespace helical
