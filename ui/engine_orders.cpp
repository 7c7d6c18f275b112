#include "ui/engine_orders.h"

#include <QDir>

#include "engine/base/error.h"
#include "engine/geometry/rotation.h"
#include "ui/open_dialog.h"

namespace helical {
namespace {

constexpr double kGustSeconds = 1.5;

}  // namespace

template <class Order>
void EngineOrders::attempt(const QString& what, const Order& order) {
  if (!engine_) return;
  try {
    order();
  } catch (const Error& error) {
    openNotice(window_, what, QString::fromStdString(error.problem() + ".\n\n" + error.cure() + "."));
  }
}

void EngineOrders::arm(bool arm) {
  if (!engine_) return;
  if (arm)
    engine_->arm();
  else
    engine_->disarm();
}

void EngineOrders::takeOff() {
  if (engine_) engine_->takeOff();
}

void EngineOrders::hold() {
  if (engine_) engine_->hold();
}

void EngineOrders::land() {
  if (engine_) engine_->land();
}

void EngineOrders::stop() {
  if (engine_) engine_->kill();
}

void EngineOrders::hideCamera(CameraId camera, bool hidden) {
  if (engine_) engine_->hideCamera(camera, hidden);
}

void EngineOrders::setBoards(CameraId camera, const WhiteBoards& boards) {
  if (engine_) engine_->setBoards(camera, boards);
}

void EngineOrders::loseFrames(CameraId camera, double share) {
  if (engine_) engine_->loseFrames(camera, share);
}

void EngineOrders::addNoise(CameraId camera, double grey_levels, double px) {
  if (engine_) engine_->addNoise(camera, grey_levels, px);
}

void EngineOrders::knock(CameraId camera, double angle_deg, double distance_m) {
  if (engine_) engine_->knockCamera(camera, toRadians(angle_deg), distance_m);
}

void EngineOrders::gust(double speed) {
  if (engine_) engine_->gust({speed, 0.3 * speed, 0.0}, kGustSeconds);
}

void EngineOrders::setMarkerColour(const ColourRange& range) {
  attempt(tr("Colour of the markers"), [&] { engine_->setMarkerColour(range); });
}

void EngineOrders::takeBackground() {
  attempt(tr("New background"), [&] { engine_->takeBackground(); });
}

void EngineOrders::setCalibrator(const QString& method) {
  attempt(tr("Calibration method"), [&] { engine_->setCalibrator(method.toStdString()); });
}

void EngineOrders::restartCalibration(CameraId camera) {
  if (engine_) engine_->restartCalibration(camera);
}

void EngineOrders::orderCalibration(CameraId camera, CalibrationOrderKind kind) {
  if (!engine_ || engine_->orderCalibration({kind, camera, {}, Matrix6d::Zero()})) return;
  openNotice(window_, tr("Not ordered"), tr("The engine is still busy with earlier orders. Try again."));
}

void EngineOrders::loadCalibration() {
  askWhatToOpen(window_, tr("Load a calibration"), QDir::currentPath(), tr("Calibrations (*.toml)"),
                [this](const QString& file) { adoptCalibration(file, {}); });
}

void EngineOrders::saveCalibration() {
  askWhereToSave(window_, tr("Save the calibration"), QStringLiteral("calibration.toml"),
                 tr("Calibrations (*.toml)"), [this](const QString& file) { writeCalibration(file, {}); });
}

void EngineOrders::loadPlace(CameraId camera) {
  askWhatToOpen(window_, tr("Load the place of one camera"), QDir::currentPath(), tr("Calibrations (*.toml)"),
                [this, camera](const QString& file) { adoptCalibration(file, camera); });
}

void EngineOrders::savePlace(CameraId camera) {
  askWhereToSave(window_, tr("Save the place of one camera"),
                 QStringLiteral("camera-%1.toml").arg(camera.index() + 1), tr("Calibrations (*.toml)"),
                 [this, camera](const QString& file) { writeCalibration(file, camera); });
}

void EngineOrders::adoptCalibration(const QString& file, std::optional<CameraId> only) {
  attempt(tr("Calibration not loaded"), [&] { engine_->adoptCalibration(file.toStdString(), only); });
}

void EngineOrders::writeCalibration(const QString& file, std::optional<CameraId> only) {
  attempt(tr("Calibration not saved"), [&] { engine_->saveCalibration(file.toStdString(), only); });
}

void EngineOrders::change(const FlightChange& change) {
  attempt(tr("Not changed"), [&] { engine_->change(change); });
  Q_EMIT changed();
}

}  // namespace helical
