#pragma once

#include <QDialog>
#include <functional>
#include <memory>
#include <vector>

#include "engine/transmitter/channel_measurement.h"
#include "engine/transmitter/transmitter_options.h"

class QCheckBox;
class QDoubleSpinBox;
class QLabel;
class QPushButton;
class QRadioButton;
class QStackedWidget;

namespace helical {

class ChannelPage;
class DirectionPage;

/// Guides through the calibration of a USB transmitter: motors off; at an analogue output one page for each
/// channel, whose voltages are tried as they are typed, at a radio how much of each is wanted; then a look
/// which way each stick goes. What was found is saved at the end. Owns the device meanwhile: nobody may fly
/// with it.
class ChannelsDialog : public QDialog {
  Q_OBJECT

 public:
  /// Writes the result down; throws Error when it cannot. `checked`: somebody has looked at the directions.
  using Saver = std::function<void(const OutputChannels& channels, bool checked)>;

  ChannelsDialog(const TransmitterOptions& transmitter, Saver save, QWidget* parent = nullptr);
  ~ChannelsDialog() override;

  QCheckBox* motorsOff() const { return motors_off_; }
  QRadioButton* mixedButton() const { return mixed_; }
  QRadioButton* rotorsButton() const { return rotors_; }
  QPushButton* nextButton() const { return next_; }
  QPushButton* backButton() const { return back_; }
  DirectionPage& directions() const { return *directions_; }
  /// Of the axis that is asked for now; null on the other pages.
  ChannelPage* page() const;
  QString problem() const;

 private:
  QWidget* buildIntroduction();
  QWidget* buildDeflections();
  QWidget* buildEnd();
  void buildChannelPages();
  void addPage(const QString& title, QWidget* page);
  void connectPage(ChannelPage& page);
  QDoubleSpinBox* addNumber(QWidget& box, const QString& name, const QString& unit, double value, double highest);

  void goTo(int index);
  void enter(int index);
  void showButtons();
  void leave();
  void goOn();
  void goBack();
  void save();
  OutputChannels measured() const;
  void attempt(const std::function<void()>& action);
  void showProblem(const QString& text);

  TransmitterOptions transmitter_;
  Saver save_;
  std::unique_ptr<OutputProbe> probe_;
  QLabel* title_;
  QLabel* problem_;
  QStackedWidget* pages_;
  std::vector<QString> titles_;
  QCheckBox* motors_off_ = nullptr;
  QRadioButton* mixed_ = nullptr;
  QRadioButton* rotors_ = nullptr;
  QDoubleSpinBox* thrust_ = nullptr;
  QDoubleSpinBox* yaw_ = nullptr;
  QDoubleSpinBox* tilt_ = nullptr;
  std::vector<ChannelPage*> channels_;
  DirectionPage* directions_ = nullptr;
  QLabel* end_ = nullptr;
  QPushButton* back_;
  QPushButton* next_;
};

}  // namespace helical
