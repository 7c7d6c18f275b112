#include "ui/event_panel.h"

#include <QHBoxLayout>
#include <QLineEdit>
#include <QToolButton>
#include <QVBoxLayout>

#include "ui/event_list.h"
#include "ui/theme.h"

namespace helical {

EventPanel::EventPanel(QWidget* parent) : QWidget(parent), list_(new EventList), words_(new QLineEdit) {
  setAccessibleName(tr("Events"));
  auto* line = new QHBoxLayout;
  line->setContentsMargins(8, 6, 8, 2);
  line->setSpacing(4);
  const struct {
    QString name;
    QString tip;
  } kinds[] = {{tr("Info"), tr("Show what is as it should be")},
               {tr("Good"), tr("Show what became better")},
               {tr("Caution"), tr("Show what to keep an eye on")},
               {tr("Danger"), tr("Show what needs somebody now")}};
  for (std::size_t i = 0; i < severities_.size(); ++i) {
    auto* button = new QToolButton;
    button->setObjectName(QStringLiteral("small"));
    button->setIcon(EventList::sign(static_cast<Severity>(i)));
    button->setCheckable(true);
    button->setChecked(true);
    button->setFixedSize(26, 21);
    button->setFocusPolicy(Qt::TabFocus);
    button->setAccessibleName(kinds[i].name);
    button->setToolTip(kinds[i].tip);
    connect(button, &QToolButton::toggled, this, &EventPanel::filter);
    severities_[i] = button;
    line->addWidget(button);
  }
  words_->setPlaceholderText(tr("Filter"));
  words_->setAccessibleName(tr("Words to filter the events by"));
  words_->setToolTip(tr("Only events that have these words"));
  words_->setClearButtonEnabled(true);
  words_->setFont(theme::uiFont(8.4));
  connect(words_, &QLineEdit::textChanged, this, &EventPanel::filter);
  line->addWidget(words_, 1);
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(0);
  layout->addLayout(line);
  layout->addWidget(list_, 1);
}

void EventPanel::add(const EngineEvent& event) {
  list_->add(event);
}

void EventPanel::filter() {
  unsigned shown = 0;
  for (std::size_t i = 0; i < severities_.size(); ++i)
    if (severities_[i]->isChecked()) shown |= 1U << i;
  list_->filter(shown, words_->text());
}

}  // namespace helical
