#include "ui/plot_deck.h"

#include <QAction>
#include <QActionGroup>
#include <QStackedWidget>
#include <QToolButton>
#include <QVBoxLayout>

#include "ui/latency_plot.h"
#include "ui/panel_title.h"
#include "ui/plot_page.h"
#include "ui/small_button.h"
#include "ui/time_plots.h"

namespace helical {

PlotDeck::PlotDeck(const RigConfig& rig, QWidget* parent)
    : QWidget(parent),
      history_(static_cast<int>(rig.cameras.size())),
      stack_(new QStackedWidget),
      choice_(new QActionGroup(this)) {
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->addWidget(stack_);
  for (const PlotPage& page : {flightPage(), calibrationPage(rig, history_), labellingPage(rig, history_),
                               featurePage(rig, history_), trackingPage(rig, history_)}) {
    auto* plots = new TimePlots(rig, page, history_, axis_);
    sheets_.push_back(plots);
    addSheet(plots, page.name, page.tip);
  }
  latency_ = new LatencyPlot(rig, history_);
  addSheet(latency_, tr("Latency"), tr("How long the frames were on their way"));
  connect(&axis_, &TimeAxis::changed, this, &PlotDeck::redraw);
  showSheet(kFlight);
}

void PlotDeck::addSheet(QWidget* sheet, const QString& name, const QString& tip) {
  stack_->addWidget(sheet);
  QAction* action = choice_->addAction(name);
  action->setCheckable(true);
  action->setToolTip(tip);
  const int index = stack_->count() - 1;
  connect(action, &QAction::triggered, this, [this, index] { showSheet(static_cast<Sheet>(index)); });
}

void PlotDeck::addControls(PanelTitle& title) {
  const auto add = [&title](QToolButton* button, const QString& name) {
    makeSmall(*button, name);
    title.addWidget(button);
  };
  for (QAction* action : choice_->actions()) {
    auto* button = new QToolButton;
    button->setDefaultAction(action);
    add(button, tr("%1 plots").arg(action->text()));
  }
  auto* live = new QToolButton;
  live->setCheckable(true);
  live->setChecked(true);
  live->setText(tr("Live"));
  live->setToolTip(
      tr("Follow the newest values, or stand still (Space). Drag a plot to scroll back, turn the "
         "wheel to zoom, double click to follow again."));
  add(live, tr("Live plots"));
  connect(live, &QToolButton::clicked, &axis_, &TimeAxis::setLive);
  connect(&axis_, &TimeAxis::liveChanged, live, [live](bool on) { live->setChecked(on); });
}

void PlotDeck::showSheet(Sheet sheet) {
  stack_->setCurrentIndex(sheet);
  choice_->actions().at(sheet)->setChecked(true);
  redraw();
}

void PlotDeck::redraw() {
  if (history_.end() > 0) axis_.advance(history_.time(history_.first()), history_.time(history_.end() - 1));
  if (!isVisible()) return;
  if (stack_->currentIndex() == kLatency)
    latency_->show(axis_.begin(), axis_.end());
  else
    sheets_[static_cast<std::size_t>(stack_->currentIndex())]->redraw();
}

}  // namespace helical
