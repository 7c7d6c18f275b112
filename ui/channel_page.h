#pragma once

#include <QWidget>
#include <array>

#include "engine/transmitter/channel_measurement.h"

class QCheckBox;
class QDoubleSpinBox;
class QFormLayout;
class QLabel;
class QSpinBox;

namespace helical {

/// One axis of an analogue transmitter: which output carries it, what it needs there for the two ends of the
/// stick's way and between them, trim, slew and reverse. Whatever voltage is looked at or changed is tried at
/// once.
class ChannelPage : public QWidget {
  Q_OBJECT

 public:
  ChannelPage(StickAxis axis, int usual_output, QWidget* parent = nullptr);

  /// On a device with so many outputs.
  void setOutputs(int count);
  OutputChannel channel() const;
  StickAxis axis() const { return axis_; }
  /// What the output has while nobody looks: rest for a throttle, neutral for the others.
  double restVolts() const;

  QSpinBox* output() const { return output_; }
  QDoubleSpinBox* lowEnd() const { return volts_[0]; }
  QDoubleSpinBox* neutral() const { return volts_[1]; }
  QDoubleSpinBox* highEnd() const { return volts_[2]; }
  QDoubleSpinBox* trim() const { return trim_; }
  QDoubleSpinBox* slew() const { return slew_; }
  QCheckBox* reverse() const { return reverse_; }
  void setTried(const QString& text);

 Q_SIGNALS:
  void outputChosen(int output);
  void tried(double volts);

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  QDoubleSpinBox* addVolts(QFormLayout& form, const QString& name, double value);
  void addLimits(QFormLayout& form);
  void turnRound();

  StickAxis axis_;
  QSpinBox* output_;
  std::array<QDoubleSpinBox*, 3> volts_{};  ///< low end, between, high end
  QDoubleSpinBox* trim_ = nullptr;
  QDoubleSpinBox* slew_ = nullptr;
  QCheckBox* reverse_ = nullptr;
  QLabel* tried_;
};

/// An axis in the window's language.
QString axisName(StickAxis axis);

}  // namespace helical
