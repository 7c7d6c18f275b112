#include "ui/preflight.h"

#include <QCoreApplication>
#include <algorithm>
#include <cmath>

#include "ui/catalogue.h"
#include "ui/format.h"
#include "ui/status_words.h"

namespace helical {
namespace {

constexpr double kGoodSigma = 0.01;  // m, of the helicopter's position
constexpr double kGoodRate = 0.8;    // of the control rate
constexpr double kDropsNoticed = 0.01;

QString tr(const char* text) {
  return QCoreApplication::translate("Preflight", text);
}

PreflightItem helicopterItem(const EngineSnapshot& now) {
  if (inFlight(now.phase)) return {Readiness::kGood, tr("Helicopter"), phaseWord(now.phase).text};
  if (now.phase == FlightPhase::kOff)
    return {Readiness::kBad, tr("Helicopter"), tr("the flight is over; start Helical anew for another one")};
  if (now.obstacle == nullptr) return {Readiness::kGood, tr("Helicopter"), tr("seen, still, on the pad")};
  return {Readiness::kBad, tr("Helicopter"), tr(now.obstacle)};
}

PreflightItem poseItem(const EngineSnapshot& now) {
  if (!now.pose_known)
    return {Readiness::kBad, tr("Pose"), tr("not known: show the markers to two calibrated cameras")};
  const double sigma = std::sqrt(std::max(0.0, now.tracked.pose_covariance.topLeftCorner<3, 3>().trace()));
  const QString text = tr("sigma %1 mm").arg(plainNumber(1e3 * sigma, 1));
  if (sigma > kGoodSigma) return {Readiness::kCaution, tr("Pose"), tr("%1: uncertain").arg(text)};
  return {Readiness::kGood, tr("Pose"), text};
}

PreflightItem controlSetItem(const EngineSnapshot& now) {
  const int tracked = trackedCameras(now);
  const QString text = tr("%1 of %2 help the pose").arg(tracked).arg(now.camera_count);
  if (tracked == 0) return {Readiness::kBad, tr("Control set"), text};
  if (tracked == 1)
    return {Readiness::kCaution, tr("Control set"), tr("%1: nothing is left if it is covered").arg(text)};
  return {Readiness::kGood, tr("Control set"), text};
}

PreflightItem cameraItem(const CameraConfig& config, const CameraSnapshot& camera, double control_rate) {
  const QString name = QString::fromStdString(config.name);
  if (camera.frames == 0)
    return {Readiness::kCaution, name, tr("no frames: look at its cable and at `helical doctor`")};
  if (camera.hidden) return {Readiness::kCaution, name, tr("hidden by the operator")};
  if (camera.boards > 0) return {Readiness::kCaution, name, tr("a white board is before it")};
  const StatusWord word = cameraStatusWord(camera.estimate.status);
  const QString rate = tr("%1 fps").arg(plainNumber(camera.frames_per_second, 0));
  if (camera.estimate.status == CameraStatus::kUncalibrated)
    return {Readiness::kCaution, name, tr("un-calibrated, not used")};
  if (camera.estimate.status == CameraStatus::kCalibrating)
    return {Readiness::kCaution, name, tr("calibrating: joins in flight")};
  if (camera.estimate.status == CameraStatus::kRejected)
    return {Readiness::kCaution, name, tr("disagrees with the others: was it knocked?")};
  if (camera.frames_per_second > 0.0 && camera.frames_per_second < kGoodRate * control_rate)
    return {Readiness::kCaution, name, tr("only %1").arg(rate)};
  if (static_cast<double>(camera.dropped) > kDropsNoticed * static_cast<double>(camera.frames))
    return {Readiness::kCaution, name, tr("%1 frames dropped").arg(camera.dropped)};
  return {Readiness::kGood, name, tr("%1, %2").arg(word.text.toLower(), rate)};
}

PreflightItem engineItem(const EngineSnapshot& now) {
  const double period_ms = now.ticks_per_second > 0.0 ? 1e3 / now.ticks_per_second : 0.0;
  const double used_ms = 1e3 * toSeconds(now.server_p99);
  const QString text = tr("%1 of %2 ms used").arg(plainNumber(used_ms, 2), plainNumber(period_ms, 1));
  if (period_ms > 0.0 && used_ms > 0.5 * period_ms)
    return {Readiness::kCaution, tr("Flight thread"), tr("%1: close other programs").arg(text)};
  return {Readiness::kGood, tr("Flight thread"), text};
}

PreflightItem safetyItem(const EngineSnapshot& now) {
  if (now.safety == SafetyState::kCut)
    return {Readiness::kBad, tr("Safety"), tr("rotors cut, latched; start Helical anew")};
  if (now.safety == SafetyState::kNormal) return {Readiness::kGood, tr("Safety"), tr("normal")};
  return {Readiness::kBad, tr("Safety"), safetyWord(now.safety).text.toLower()};
}

}  // namespace

std::vector<PreflightItem> preflightList(const RigConfig& rig, const EngineSnapshot& snapshot) {
  std::vector<PreflightItem> items{helicopterItem(snapshot), poseItem(snapshot), controlSetItem(snapshot)};
  for (std::size_t i = 0; i < rig.cameras.size(); ++i)
    items.push_back(cameraItem(rig.cameras[i], snapshot.cameras[i], snapshot.ticks_per_second));
  items.push_back(engineItem(snapshot));
  items.push_back(safetyItem(snapshot));
  if (snapshot.phase != FlightPhase::kIdle) return items;
  for (std::uint32_t bits = snapshot.failing_checks; bits != 0; bits &= bits - 1)
    items.push_back({Readiness::kBad, tr("Arming"),
                     engineText(QString::fromUtf8(toString(static_cast<PreArmCheck>(bits & (~bits + 1)))))});
  return items;
}

Readiness worstOf(const std::vector<PreflightItem>& items) {
  Readiness worst = Readiness::kGood;
  for (const PreflightItem& item : items) worst = std::max(worst, item.readiness);
  return worst;
}

}  // namespace helical
