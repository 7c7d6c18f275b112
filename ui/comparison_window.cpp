#include "ui/comparison_window.h"

#include <qcustomplot.h>

#include <QComboBox>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QPushButton>
#include <QSplitter>
#include <QTableWidget>
#include <QVBoxLayout>
#include <cmath>

#include "ui/figures/comparison_figures.h"
#include "ui/open_dialog.h"
#include "ui/theme.h"

namespace helical {
namespace {

/// The figures are for paper: black would not be seen here.
QColor onScreen(const QColor& color) {
  if (color == figures::kInk || color == figures::kQuietInk) return theme::kMuted;
  return theme::theme() == theme::Theme::kDark ? color.lighter(color.lightness() < 100 ? 190 : 130) : color;
}

QPen penOf(const figures::Stroke& stroke) {
  return QPen(onScreen(stroke.color), 1.6, stroke.style);
}

void colourAxis(QCPAxis& axis) {
  axis.setTickLabelColor(theme::kMuted);
  axis.setLabelColor(theme::kText);
  axis.setTickLabelFont(theme::monoFont(7.6));
  axis.setLabelFont(theme::uiFont(8.4));
  for (const auto set : {&QCPAxis::setBasePen, &QCPAxis::setTickPen, &QCPAxis::setSubTickPen})
    (axis.*set)(QPen(theme::kLine));
  axis.grid()->setPen(QPen(theme::kGrid));
  axis.grid()->setZeroLinePen(QPen(theme::kLine));
}

bool hasCurves(const figures::Figure& figure) {
  return !figure.panels.empty() && !figure.panels.front().curves.empty();
}

}  // namespace

ComparisonWindow::ComparisonWindow(std::vector<SessionSummary> sessions, QWidget* parent)
    : QWidget(parent),
      sessions_(std::move(sessions)),
      choice_(new QComboBox),
      plot_(new QCustomPlot),
      table_(new QTableWidget) {
  setWindowTitle(tr("Comparison of %n flight(s)", "", static_cast<int>(sessions_.size())));
  for (figures::Figure& figure : figures::comparisonFigures(sessions_))
    if (hasCurves(figure)) figures_.push_back(std::move(figure));
  auto* layout = new QVBoxLayout(this);
  auto* head = new QHBoxLayout;
  choice_->setAccessibleName(tr("Which plots"));
  for (const figures::Figure& figure : figures_) choice_->addItem(figure.title);
  auto* report = new QPushButton(tr("Save as PDF..."));
  head->addWidget(choice_);
  head->addStretch();
  head->addWidget(report);
  layout->addLayout(head);
  auto* splitter = new QSplitter(Qt::Vertical);
  splitter->addWidget(plot_);
  splitter->addWidget(table_);
  splitter->setStretchFactor(0, 3);
  splitter->setStretchFactor(1, 2);
  layout->addWidget(splitter, 1);
  plot_->setInteractions(QCP::iRangeDrag | QCP::iRangeZoom);
  plot_->setAutoAddPlottableToLegend(false);
  plot_->setAccessibleName(tr("Plots of the flights"));
  plot_->installEventFilter(this);
  buildTable();
  connect(choice_, &QComboBox::currentIndexChanged, this, &ComparisonWindow::showFigure);
  connect(report, &QPushButton::clicked, this, [this] {
    askWhereToSave(this, tr("Save the comparison"), QStringLiteral("comparison.pdf"), tr("PDF (*.pdf)"),
                   [this](const QString& file) { Q_EMIT reportRequested(file); });
  });
  showFigure(0);
  resize(1180, 860);
}

ComparisonWindow::~ComparisonWindow() = default;

void ComparisonWindow::buildTable() {
  const std::vector<ComparisonRow> rows = compareSessions(sessions_);
  table_->setRowCount(static_cast<int>(rows.size()));
  table_->setColumnCount(static_cast<int>(sessions_.size()) + 1);
  table_->setEditTriggers(QAbstractItemView::NoEditTriggers);
  table_->verticalHeader()->hide();
  table_->setAccessibleName(tr("The flights side by side"));
  QStringList heads{tr("Quantity")};
  for (std::size_t i = 0; i < sessions_.size(); ++i) heads << figures::comparisonName(sessions_, i);
  table_->setHorizontalHeaderLabels(heads);
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const ComparisonRow& row = rows[r];
    const auto set = [&](std::size_t column, const QString& text) {
      auto* item = new QTableWidgetItem(text);
      if (column > 0) item->setTextAlignment(Qt::AlignRight | Qt::AlignVCenter);
      table_->setItem(static_cast<int>(r), static_cast<int>(column), item);
    };
    set(0, QString::fromStdString(row.unit.empty() ? row.name : row.name + " [" + row.unit + "]"));
    for (std::size_t i = 0; i < row.words.size(); ++i) set(i + 1, QString::fromStdString(row.words[i]));
    for (std::size_t i = 0; i < row.values.size(); ++i)
      set(i + 1, std::isfinite(row.values[i]) ? QString::number(row.values[i], 'f', row.decimals)
                                              : QStringLiteral("\u2013"));
  }
  table_->resizeColumnsToContents();
  table_->horizontalHeader()->setSectionResizeMode(0, QHeaderView::ResizeToContents);
}

void ComparisonWindow::showFigure(int index) {
  if (index < 0 || index >= static_cast<int>(figures_.size())) return;
  const figures::Figure& figure = figures_[static_cast<std::size_t>(index)];
  plot_->clearPlottables();
  plot_->plotLayout()->clear();
  rects_.clear();
  for (std::size_t i = 0; i < figure.panels.size(); ++i) addPanel(figure, i);
  shareTime();
  takeTheme();
}

void ComparisonWindow::addPanel(const figures::Figure& figure, std::size_t index) {
  const figures::Panel& panel = figure.panels[index];
  auto* rect = new QCPAxisRect(plot_);
  plot_->plotLayout()->addElement(static_cast<int>(index), 0, rect);
  rects_.push_back(rect);
  for (QCPAxis* axis : rect->axes()) {
    axis->setLayer(QStringLiteral("axes"));
    axis->grid()->setLayer(QStringLiteral("grid"));
  }
  QCPAxis* time = rect->axis(QCPAxis::atBottom);
  QCPAxis* values = rect->axis(QCPAxis::atLeft);
  rect->setRangeZoomAxes(time, nullptr);
  rect->setRangeDragAxes(time, nullptr);
  values->setLabel(panel.y.title);
  values->setRange(panel.y.low, panel.y.high);
  if (index + 1 == figure.panels.size()) time->setLabel(panel.x.title);
  begin_s_ = panel.x.low;
  end_s_ = panel.x.high;
  time->setRange(begin_s_, end_s_);
  for (const figures::Curve& curve : panel.curves) {
    QCPGraph* graph = plot_->addGraph(time, values);
    graph->setPen(penOf(curve.stroke));
    QVector<QCPGraphData> points;
    points.reserve(static_cast<int>(curve.points.size()));
    for (const QPointF& point : curve.points) points.append(QCPGraphData(point.x(), point.y()));
    graph->data()->set(points, true);
  }
  if (index > 0) return;
  // The curves of a panel stand in the order of the legend.
  auto* legend = new QCPLegend;
  rect->insetLayout()->addElement(legend, Qt::AlignTop | Qt::AlignRight);
  legend->setLayer(QStringLiteral("legend"));
  legend->setFont(theme::uiFont(8.4));
  legend->setBrush(theme::kPanel);
  legend->setBorderPen(QPen(theme::kLine));
  legend->setTextColor(theme::kText);
  const auto& keys = figure.legend.front();
  for (int i = 0; i < std::min(plot_->graphCount(), static_cast<int>(keys.size())); ++i) {
    plot_->graph(i)->setName(keys[static_cast<std::size_t>(i)].text);
    plot_->graph(i)->addToLegend(legend);
  }
}

void ComparisonWindow::shareTime() {
  for (QCPAxisRect* rect : rects_) {
    QCPAxis* time = rect->axis(QCPAxis::atBottom);
    connect(time, qOverload<const QCPRange&>(&QCPAxis::rangeChanged), this, [this](const QCPRange& range) {
      for (QCPAxisRect* other : rects_) other->axis(QCPAxis::atBottom)->setRange(range);
    });
  }
  if (rects_.empty()) return;
  auto* margins = new QCPMarginGroup(plot_);
  for (QCPAxisRect* rect : rects_) rect->setMarginGroup(QCP::msLeft | QCP::msRight, margins);
}

bool ComparisonWindow::eventFilter(QObject* watched, QEvent* event) {
  if (watched == plot_ && event->type() == QEvent::MouseButtonDblClick && !rects_.empty()) {
    rects_.front()->axis(QCPAxis::atBottom)->setRange(begin_s_, end_s_);
    plot_->replot();
  }
  return QWidget::eventFilter(watched, event);
}

void ComparisonWindow::changeEvent(QEvent* event) {
  QWidget::changeEvent(event);
  if (event->type() == QEvent::PaletteChange) showFigure(choice_->currentIndex());
}

void ComparisonWindow::takeTheme() {
  plot_->setBackground(theme::kPanel);
  for (QCPAxisRect* rect : rects_)
    for (const auto type : {QCPAxis::atBottom, QCPAxis::atLeft}) colourAxis(*rect->axis(type));
  plot_->replot(QCustomPlot::rpQueuedReplot);
}

}  // namespace helical
