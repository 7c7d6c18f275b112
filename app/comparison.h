#pragma once

#include <QObject>
#include <QPointer>
#include <QProgressDialog>
#include <atomic>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "engine/session/session_summary.h"

namespace helical {

class ComparisonWindow;

/// Reads sessions on a thread of its own, with a bar and a way to cancel, then shows them over each other. What
/// cannot be read is told. The window's thread.
class Comparison {
 public:
  /// `keeps_open`: its window alone is reason enough for the application to go on.
  Comparison(std::vector<std::string> sessions, QWidget* parent, bool keeps_open);
  ~Comparison();  ///< cancels, and waits for that
  Comparison(const Comparison&) = delete;
  Comparison& operator=(const Comparison&) = delete;

  /// Nothing more comes of it.
  bool over() const;
  ComparisonWindow* window() const { return window_.get(); }

 private:
  void read(const std::vector<std::string>& sessions);
  void show(std::vector<SessionSummary> summaries);
  void save(const QString& file);

  QPointer<QWidget> parent_;
  bool keeps_open_;
  QPointer<QProgressDialog> bar_;
  QObject here_;  ///< what happens on the window's thread; with it ends what still waits
  std::unique_ptr<ComparisonWindow> window_;
  std::shared_ptr<const std::vector<SessionSummary>> summaries_;
  std::atomic<bool> cancelled_{false};
  std::thread thread_;
};

}  // namespace helical
