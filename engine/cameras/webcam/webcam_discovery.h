#pragma once

#include <functional>
#include <vector>

#include "engine/cameras/found_camera.h"

namespace helical {

/// Webcams (V4L2) of this machine, with what they offer. Those that another program uses answer, too.
std::vector<FoundCamera> findWebcams();

/// Adds name, formats, the largest size and the rates that a video node answers; `ask` is the system's ioctl on it.
/// False for a node that gives no pictures.
bool describeWebcam(const std::function<int(unsigned long request, void* answer)>& ask, FoundCamera& found);

}  // namespace helical
