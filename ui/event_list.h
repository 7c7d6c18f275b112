#pragma once

#include <QIcon>
#include <QListWidget>

#include "engine/pipeline/snapshot.h"

namespace helical {

/// What happened, newest at the bottom, each with a sign of its own shape and colour for its severity. A
/// danger that somebody has acknowledged has a tick.
class EventList : public QListWidget {
  Q_OBJECT

 public:
  explicit EventList(QWidget* parent = nullptr);

  /// One from before the last begins anew: a recording that was wound back.
  void add(const EngineEvent& event);
  /// Shows events of the severities whose bits are set, and which have these words.
  void filter(unsigned severities, const QString& words);
  /// Somebody has seen all dangers so far.
  void acknowledge();
  int shownCount() const;
  int unacknowledgedCount() const;
  static QIcon sign(Severity severity);
  QSize sizeHint() const override { return {272, 200}; }
  QSize minimumSizeHint() const override { return {200, 80}; }

 private:
  TimeNs last_ = 0;
  bool passes(const QListWidgetItem& item) const;

  unsigned severities_ = 0xF;
  QString words_;
};

}  // namespace helical
