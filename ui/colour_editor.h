#pragma once

#include <QDialog>
#include <array>
#include <vector>

#include "engine/markers/marker_options.h"

class QGridLayout;
class QLabel;
class QPushButton;
class QSlider;
class QSpinBox;

namespace helical {

/// Which colours are a marker's: a click on a ball in any picture proposes a range, six sliders change it,
/// the pictures show at once what it would find. The engine hears of it at Apply; Undo brings back what was
/// applied before.
class ColourEditor : public QDialog {
  Q_OBJECT

 public:
  explicit ColourEditor(QWidget* parent);

  /// Begins with the range that is in force.
  void begin(const ColourRange& applied);
  void propose(const ColourRange& range);
  /// The click hit nothing that has a colour.
  void tellNothingPicked();
  const ColourRange& range() const { return range_; }

  QPushButton* applyButton() const { return apply_; }
  QPushButton* undoButton() const { return undo_; }
  QSlider* slider(int index) const { return sliders_[static_cast<std::size_t>(index)]; }

 Q_SIGNALS:
  void rangeChanged(const helical::ColourRange& range);
  void applyRequested(const helical::ColourRange& range);
  void closed();

 protected:
  void hideEvent(QHideEvent* event) override;

 private:
  void buildSlider(int index, const QString& name, int highest, QGridLayout& grid);
  void setRange(const ColourRange& range);
  void apply();
  void undo();
  void enableButtons();

  ColourRange range_;
  std::vector<ColourRange> applied_;  ///< the last is in force
  std::array<QSlider*, 6> sliders_{};
  std::array<QSpinBox*, 6> numbers_{};
  QLabel* hint_;
  QPushButton* apply_;
  QPushButton* undo_;
};

}  // namespace helical
