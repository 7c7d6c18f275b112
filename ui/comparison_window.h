#pragma once

#include <QWidget>
#include <vector>

#include "engine/session/session_comparison.h"
#include "ui/figures/figure.h"

class QCPAxisRect;
class QComboBox;
class QCustomPlot;
class QTableWidget;

namespace helical {

/// Several recorded flights over each other: their plots on one time axis, which counts from when their rotors
/// began to turn, with a legend, and one table of what tells them apart. Drag scrolls, the wheel zooms the
/// time, a double click shows all of it. The window's thread.
class ComparisonWindow : public QWidget {
  Q_OBJECT

 public:
  explicit ComparisonWindow(std::vector<SessionSummary> sessions, QWidget* parent = nullptr);
  ~ComparisonWindow() override;

  QTableWidget* table() const { return table_; }
  QComboBox* choice() const { return choice_; }
  QCustomPlot* plot() const { return plot_; }

 Q_SIGNALS:
  void reportRequested(const QString& file);

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;
  void changeEvent(QEvent* event) override;

 private:
  void buildTable();
  void showFigure(int index);
  void addPanel(const figures::Figure& figure, std::size_t index);
  void shareTime();
  void takeTheme();

  const std::vector<SessionSummary> sessions_;
  std::vector<figures::Figure> figures_;
  std::vector<QCPAxisRect*> rects_;
  QComboBox* choice_;
  QCustomPlot* plot_;
  QTableWidget* table_;
  double begin_s_ = 0.0, end_s_ = 1.0;
};

}  // namespace helical
