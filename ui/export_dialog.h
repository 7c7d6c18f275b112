#pragma once

#include <QDialog>
#include <string>
#include <vector>

#include "engine/session/export_selection.h"

class QCheckBox;
class QDoubleSpinBox;
class QLabel;
class QLineEdit;
class QListWidget;
class QProgressBar;
class QPushButton;

namespace helical {

/// What there is to export of a session.
struct ExportContents {
  std::filesystem::path session;
  std::vector<std::string> topics;  ///< of tables
  double begin_s = 0.0, end_s = 0.0;
  bool images = false;  ///< of any camera
};

/// Asks which streams and which span of a recorded flight become which files, shows how far they are, and
/// cancels. Does not write any of them; closing it while they are being written cancels, too.
class ExportDialog : public QDialog {
  Q_OBJECT

 public:
  explicit ExportDialog(const ExportContents& contents, QWidget* parent = nullptr);

  ExportOrder order() const;

 public Q_SLOTS:
  void showProgress(double done, const QString& step);
  /// What became of it; it can be started again.
  void showEnd(const QString& text);

 Q_SIGNALS:
  void startRequested(const helical::ExportOrder& order);
  void cancelRequested();

 protected:
  void reject() override;

 private:
  QWidget* buildFormats();
  QWidget* buildStreams();
  QWidget* buildSpan();
  QWidget* buildFolder();
  QWidget* buildEnd();
  void setRunning(bool running);
  void updateStart();

  const ExportContents contents_;
  QCheckBox *tables_, *films_, *scene_, *png_, *pdf_;
  QListWidget* streams_;
  QDoubleSpinBox *from_, *to_;
  QLineEdit* folder_;
  QProgressBar* bar_;
  QLabel* state_;
  QPushButton *start_, *cancel_;
  bool running_ = false;
};

}  // namespace helical
