#pragma once

#include <QTimer>
#include <QWidget>
#include <memory>

#include "engine/transmitter/transmitter_options.h"

class QLabel;
class QPushButton;

namespace helical {

class HeldSticks;

/// Moves one stick after the other and asks whether it goes the right way; motors off. One that goes the wrong way is
/// turned round and looked at again.
class DirectionPage : public QWidget {
  Q_OBJECT

 public:
  explicit DirectionPage(QWidget* parent = nullptr);
  ~DirectionPage() override;

  /// Begins with the first channel. Throws Error(kDevice) when the device is missing.
  void begin(const TransmitterOptions& transmitter);
  /// Sticks back at rest; the device is free.
  void end();
  /// With the sticks that were turned round.
  const OutputChannels& channels() const { return transmitter_.channels; }
  bool done() const { return step_ >= transmitter_.channels.count; }

  QPushButton* rightButton() const { return right_; }
  QPushButton* wrongButton() const { return wrong_; }
  QString question() const;

 Q_SIGNALS:
  void finished();
  /// Why it cannot go on.
  void failed(const QString& problem);

 private:
  void look();
  void hold();
  void answer(bool right);

  TransmitterOptions transmitter_;
  int step_ = 0;
  std::unique_ptr<HeldSticks> sticks_;
  QTimer renewal_;
  QLabel* question_;
  QPushButton* right_;
  QPushButton* wrong_;
};

}  // namespace helical
