#pragma once

#include <vector>

#include "engine/cameras/found_camera.h"

namespace helical {

/// Webcams (V4L2) of this machine, with what they offer. Those that another program uses answer, too.
std::vector<FoundCamera> findWebcams();

}  // namespace helical
