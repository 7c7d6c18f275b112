#pragma once

#include <QListWidget>

#include "engine/pipeline/snapshot.h"

namespace helical {

/// What happened, newest at the bottom, each with a sign of its own shape and colour for its severity.
class EventList : public QListWidget {
  Q_OBJECT

 public:
  explicit EventList(QWidget* parent = nullptr);

  /// One from before the last begins anew: a recording that was wound back.
  void add(const EngineEvent& event);
  QSize sizeHint() const override { return {272, 200}; }
  QSize minimumSizeHint() const override { return {200, 80}; }

 private:
  TimeNs last_ = 0;
};

}  // namespace helical
