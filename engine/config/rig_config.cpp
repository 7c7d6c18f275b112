#include "engine/config/rig_config.h"

#include "engine/base/error.h"

namespace helical {

void RigConfig::replaceMarkers(std::span<const Eigen::Vector3d> places) {
  if (static_cast<int>(places.size()) != markers_in_body.count())
    throw Error(ErrorKind::kInput,
                "the calibration has " + std::to_string(places.size()) + " balls, the rig " +
                    std::to_string(markers_in_body.count()),
                path, "give a calibration that was saved with this rig");
  if (!simulation.markers_before) simulation.markers_before = markers_in_body;
  markers_in_body = MarkerLayout(places, markers_in_body.radius());
}

void RigConfig::replaceFocalLengths(std::size_t index, double scale) {
  CameraConfig& camera = cameras[index];
  if (scale == camera.focal_scale) return;
  simulation.models_before.resize(cameras.size());
  auto& before = simulation.models_before[index];
  if (!before) before = camera.model;
  camera.model = before->withFocalScale(scale);
  camera.focal_scale = scale;
}

CameraId RigConfig::camera(const std::string& label) const {
  std::string known;
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    if (cameras[i].label == label) return cameraId(static_cast<int>(i));
    known += (i == 0 ? "" : ", ") + cameras[i].label;
  }
  throw Error(ErrorKind::kInput, "there is no camera '" + label + "'", path,
              "this rig's cameras are: " + known);
}

}  // namespace helical
