#include "engine/config/rig_config.h"

#include "engine/base/error.h"

namespace helical {

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
