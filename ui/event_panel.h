#pragma once

#include <QWidget>
#include <array>

#include "engine/pipeline/snapshot.h"

class QLineEdit;
class QToolButton;

namespace helical {

class EventList;

/// The list of events under a line that filters it: by severity and by words.
class EventPanel : public QWidget {
  Q_OBJECT

 public:
  explicit EventPanel(QWidget* parent = nullptr);

  void add(const EngineEvent& event);
  EventList& list() const { return *list_; }
  QLineEdit* words() const { return words_; }
  QToolButton* severityButton(Severity severity) const {
    return severities_[static_cast<std::size_t>(severity)];
  }

 private:
  void filter();

  EventList* list_;
  QLineEdit* words_;
  std::array<QToolButton*, 4> severities_{};
};

}  // namespace helical
