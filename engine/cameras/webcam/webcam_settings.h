#pragma once

#include <string>

#include "engine/cameras/camera_link.h"
#include "engine/cameras/device_options.h"
#include "engine/cameras/video/video_capture.h"

namespace helical {

/// Gives an opened webcam the rig's settings and reads back what became of them. What it does not offer throws
/// Error(kInput) that says what it gives instead. `where` names the camera.
void applyWebcamSettings(VideoCapture& capture, const DeviceOptions& options, int width, int height,
                         const std::string& where);

/// What a webcam has taken. One that times its exposure by itself tells nothing of use.
LightSetting lightOf(const VideoCapture& capture, const DeviceOptions& options);

}  // namespace helical
