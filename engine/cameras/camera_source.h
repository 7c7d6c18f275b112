#pragma once

#include <optional>

#include "engine/cameras/frame.h"

namespace helical {

/// Where frames come from: a device, a file or the simulator. One thread, the camera's capture thread, calls `poll`
/// and `wait`.
class CameraSource {
 public:
  virtual ~CameraSource() = default;

  virtual CameraId camera() const = 0;

  /// Of its frames, where that is known before the first one: what reading them needs can be made in time.
  virtual std::optional<PixelFormat> format() const { return std::nullopt; }

  /// The oldest frame that has arrived by now and was not yet polled; false if there is none. Never blocks.
  virtual bool poll(Frame& frame) = 0;

  /// Blocks until a frame can be polled or the clock passes `deadline`.
  virtual void wait(TimeNs deadline) = 0;
};

}  // namespace helical
