#pragma once

#include <QLabel>

#include "engine/pipeline/snapshot.h"

namespace helical {

/// Whether this flight is recorded, with pictures or without, and what the disk has room for: one line of the
/// status bar.
class RecordLabel : public QLabel {
  Q_OBJECT

 public:
  explicit RecordLabel(QWidget* parent = nullptr);

  void showRecord(const RecordHealth& record, bool pictures);
};

}  // namespace helical
