#include "engine/pipeline/calibration_record.h"

#include <algorithm>
#include <ctime>
#include <filesystem>
#include <span>
#include <string>

#include "engine/base/error.h"

namespace helical {
namespace {

std::string utcNow() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  gmtime_r(&now, &parts);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &parts);
  return text;
}

const MarkerLayout& ballsOfFile(const RigConfig& rig) {
  return rig.simulation.markers_before ? *rig.simulation.markers_before : rig.markers_in_body;
}

double ballsOff(const SavedCalibration& saved, const RigConfig& rig, const MarkerLayout& flown_with) {
  const std::span<const Eigen::Vector3d> balls =
      saved.markers_in_body.empty() ? ballsOfFile(rig).all() : std::span(saved.markers_in_body);
  if (static_cast<int>(balls.size()) != flown_with.count())
    throw Error(ErrorKind::kInput,
                "the calibration is of a helicopter with " + std::to_string(balls.size()) + " balls",
                saved.rig, "load one of a helicopter with " + std::to_string(flown_with.count()));
  double farthest = 0.0;
  for (std::size_t m = 0; m < balls.size(); ++m)
    farthest = std::max(farthest, (balls[m] - flown_with.all()[m]).norm());
  return farthest;
}

}  // namespace

SavedCalibration calibrationOf(const RigConfig& rig, const EngineSnapshot& now) {
  SavedCalibration saved;
  saved.rig = std::filesystem::path(rig.path).filename().string();
  saved.written = utcNow();
  saved.after_s = toSeconds(now.time);
  for (std::size_t i = 0; i < rig.cameras.size(); ++i) {
    const CameraSnapshot& camera = now.cameras[i];
    if (camera.estimate.status != CameraStatus::kCalibrated) continue;
    const char* method = camera.calibration_method;
    saved.cameras.push_back({rig.cameras[i].label, method != nullptr ? method : "given",
                             camera.estimate.camera_from_world, camera.estimate.covariance,
                             rig.cameras[i].focal_scale * camera.focal_scale});
  }
  const MarkerLayout& of_file = ballsOfFile(rig);
  if (!std::ranges::equal(of_file.all(), now.markers.all()))
    saved.markers_in_body.assign(now.markers.all().begin(), now.markers.all().end());
  if (saved.cameras.empty())
    throw Error(ErrorKind::kInput, "no camera is calibrated: there is nothing to save", rig.path,
                "wait until one is in the control set");
  return saved;
}

SavedCalibration onlyOf(const SavedCalibration& saved, const CameraConfig& camera) {
  SavedCalibration one = saved;
  std::erase_if(one.cameras, [&](const SavedCamera& each) { return each.label != camera.label; });
  if (one.cameras.empty())
    throw Error(ErrorKind::kInput, camera.name + " is not among the cameras whose place is known here", saved.rig,
                "wait until it is calibrated, or choose a calibration that has camera " + camera.label);
  return one;
}

std::vector<CalibrationOrder> adoptOrders(const SavedCalibration& saved, const RigConfig& rig,
                                          const MarkerLayout& flown_with) {
  const double balls_off_m = ballsOff(saved, rig, flown_with);
  std::vector<CalibrationOrder> orders;
  for (const SavedCamera& camera : saved.cameras) {
    const CameraId id = rig.camera(camera.label);
    const double scale = camera.focal_scale / rig.cameras[static_cast<std::size_t>(id.index())].focal_scale;
    orders.push_back(
        {CalibrationOrderKind::kAdopt, id, camera.camera_from_world, camera.covariance, scale, balls_off_m});
  }
  return orders;
}

void giveCalibration(const SavedCalibration& saved, RigConfig& rig) {
  rig.simulation.true_camera_from_world.resize(rig.cameras.size());
  if (!saved.markers_in_body.empty()) rig.replaceMarkers(saved.markers_in_body);
  for (const SavedCamera& camera : saved.cameras) {
    const auto index = static_cast<std::size_t>(rig.camera(camera.label).index());
    CameraConfig& config = rig.cameras[index];
    auto& truth = rig.simulation.true_camera_from_world[index];
    if (!truth && !config.pose_is_guess) truth = config.camera_from_world;
    config.camera_from_world = camera.camera_from_world;
    config.pose_is_guess = false;
    config.pose_covariance = camera.covariance;
    rig.replaceFocalLengths(index, camera.focal_scale);
  }
}

}  // namespace helical
