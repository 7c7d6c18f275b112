#pragma once

#include <QWidget>
#include <vector>

#include "engine/flight/controller_options.h"

class QDoubleSpinBox;
class QGridLayout;
class QLabel;
class QPushButton;

namespace helical {

/// Gains and trims within their safe ranges, with units, as a draft: all that was changed takes effect at one
/// control tick with Apply. Changed values are marked.
class TuningEditor : public QWidget {
  Q_OBJECT

 public:
  explicit TuningEditor(const ControllerOptions& from_rig, QWidget* parent = nullptr);

  /// What is in force.
  void setControl(const ControllerOptions& control);
  const ControllerOptions& draft() const { return draft_; }
  /// By its key's name; null for none.
  QDoubleSpinBox* number(const char* key) const;

  QPushButton* applyButton() const { return apply_; }
  QPushButton* revertButton() const { return revert_; }
  QPushButton* defaultsButton() const { return defaults_; }

 Q_SIGNALS:
  void applyRequested(const helical::ControllerOptions& control);

 private:
  void addRow(const ControllerKey& key, QGridLayout& grid);
  void fill();
  void mark();

  ControllerOptions from_rig_;
  ControllerOptions control_;
  ControllerOptions draft_;
  bool filling_ = false;
  std::vector<QDoubleSpinBox*> numbers_;
  std::vector<QLabel*> names_;
  QPushButton* defaults_;
  QPushButton* revert_;
  QPushButton* apply_;
};

}  // namespace helical
