#pragma once

#include <QDialog>

namespace helical {

/// The sheet of keys and mouse gestures that F1 opens.
class KeySheet : public QDialog {
  Q_OBJECT

 public:
  explicit KeySheet(QWidget* parent);
};

}  // namespace helical
