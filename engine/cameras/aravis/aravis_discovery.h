#pragma once

#include <vector>

#include "engine/cameras/found_camera.h"

namespace helical {

/// GigE Vision and USB3 Vision cameras that answer now; takes a second. Those that nobody controls are opened to ask
/// for what they offer, and left as they were.
std::vector<FoundCamera> findAravisCameras();

}  // namespace helical
