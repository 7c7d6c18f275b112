#pragma once

#include <QDialog>

class QTextBrowser;

namespace helical {

/// The manual to read and to scroll beside a flight, from a Markdown file; what it says of a file that is
/// missing is shown in its place.
class ManualWindow : public QDialog {
  Q_OBJECT

 public:
  explicit ManualWindow(const QString& file, QWidget* parent = nullptr);

  QTextBrowser& text() const { return *text_; }

 private:
  QTextBrowser* text_;
};

}  // namespace helical
