#pragma once

#include <QObject>
#include <QWidget>
#include <optional>

#include "engine/pipeline/engine.h"

namespace helical {

/// Hands what the panels ask for to the engine, if there is one; a refusal is shown to the user. What came of
/// an order the panels learn from the snapshot, as of everything else.
class EngineOrders : public QObject {
  Q_OBJECT

 public:
  /// Notices open over `window`.
  explicit EngineOrders(QWidget* window) : QObject(window), window_(window) {}

  void setEngine(Engine* engine) { engine_ = engine; }
  Engine* engine() const { return engine_; }

 public Q_SLOTS:
  void arm(bool arm);
  void takeOff();
  void hold();
  void land();
  void stop();
  void hideCamera(helical::CameraId camera, bool hidden);
  void setBoards(helical::CameraId camera, const helical::WhiteBoards& boards);
  void loseFrames(helical::CameraId camera, double share);
  void addNoise(helical::CameraId camera, double grey_levels, double px);
  void knock(helical::CameraId camera, double angle_deg, double distance_m);
  void gust(double speed);
  void setMarkerColour(const helical::ColourRange& range);
  void takeBackground();
  void setCalibrator(const QString& method);
  void restartCalibration(helical::CameraId camera);
  void orderCalibration(helical::CameraId camera, helical::CalibrationOrderKind kind);
  /// Both ask for the file first.
  void loadCalibration();
  void saveCalibration();
  /// The same for one camera.
  void loadPlace(helical::CameraId camera);
  void savePlace(helical::CameraId camera);
  void change(const helical::FlightChange& change);

 Q_SIGNALS:
  /// After `change`, whether it was refused or not.
  void changed();

 private:
  void adoptCalibration(const QString& file, std::optional<CameraId> only);
  void writeCalibration(const QString& file, std::optional<CameraId> only);
  template <class Order>
  void attempt(const QString& what, const Order& order);

  QWidget* window_;
  Engine* engine_ = nullptr;
};

}  // namespace helical
