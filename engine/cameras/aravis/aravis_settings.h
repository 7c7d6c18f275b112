#pragma once

#include <string>

#include "engine/cameras/camera_link.h"
#include "engine/cameras/device_options.h"
#include "engine/cameras/frame.h"

struct _ArvCamera;

namespace helical {

/// Gives a camera every setting of the rig, whatever it had before. What it does not offer throws Error(kInput) that
/// says what it offers; what fails on the way throws Error(kDevice). `where` names the camera in both.
void applySettings(_ArvCamera* camera, const DeviceOptions& options, int width, int height, const std::string& where);

/// What it has taken, which need not be what it was asked for.
LightSetting lightOf(_ArvCamera* camera);

/// Our name of a GenICam pixel format; false for one that nothing here reads.
bool toPixelFormat(unsigned genicam_format, PixelFormat& format);

}  // namespace helical
