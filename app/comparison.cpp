#include "app/comparison.h"

#include <QMetaObject>
#include <utility>

#include "engine/base/error.h"
#include "ui/comparison_window.h"
#include "ui/figures/session_report.h"
#include "ui/open_dialog.h"

namespace helical {
namespace {

constexpr int kBarSteps = 1000;

}  // namespace

Comparison::Comparison(std::vector<std::string> sessions, QWidget* parent, bool keeps_open)
    : parent_(parent), keeps_open_(keeps_open) {
  bar_ = new QProgressDialog(QObject::tr("Reading %n session(s)", "", static_cast<int>(sessions.size())),
                             QObject::tr("Cancel"), 0, kBarSteps, parent);
  bar_->setAutoReset(false);
  QObject::connect(bar_, &QProgressDialog::canceled, &here_, [this] { cancelled_ = true; });
  openDialog(bar_);
  thread_ = std::thread([this, sessions = std::move(sessions)] { read(sessions); });
}

Comparison::~Comparison() {
  cancelled_ = true;
  thread_.join();
  delete bar_;
}

bool Comparison::over() const {
  return bar_.isNull() && (!window_ || !window_->isVisible());
}

/// The thread of its own.
void Comparison::read(const std::vector<std::string>& sessions) {
  std::vector<SessionSummary> summaries;
  QString failure;
  try {
    summaries = summarizeAll(sessions, [&](double done) {
      if (cancelled_) throw ExportCancelled();
      const int step = static_cast<int>(kBarSteps * done);
      QMetaObject::invokeMethod(&here_, [this, step] {
        if (bar_ && !cancelled_) bar_->setValue(step);
      });
    });
  } catch (const ExportCancelled&) {
    summaries.clear();
  } catch (const std::exception& error) {
    failure = QString::fromUtf8(error.what());
  }
  const auto read = std::make_shared<std::vector<SessionSummary>>(std::move(summaries));
  QMetaObject::invokeMethod(&here_, [this, read, failure] {
    const bool wanted = !cancelled_;  // closing the bar cancels
    if (bar_) bar_->close();
    if (!failure.isEmpty()) return openNotice(parent_, QObject::tr("The sessions cannot be compared"), failure);
    if (read->size() > 1 && wanted) show(std::move(*read));
  });
}

void Comparison::show(std::vector<SessionSummary> summaries) {
  summaries_ = std::make_shared<const std::vector<SessionSummary>>(summaries);
  window_ = std::make_unique<ComparisonWindow>(std::move(summaries));
  window_->setAttribute(Qt::WA_QuitOnClose, keeps_open_);
  QObject::connect(window_.get(), &ComparisonWindow::reportRequested, &here_,
                   [this](const QString& file) { save(file); });
  window_->show();
}

void Comparison::save(const QString& file) {
  try {
    figures::writeComparisonReport(*summaries_, file.toStdString());
  } catch (const Error& error) {
    openNotice(window_.get(), QObject::tr("The comparison cannot be saved"), QString::fromUtf8(error.what()));
  }
}

}  // namespace helical
