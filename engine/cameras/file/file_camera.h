#pragma once

#include <filesystem>
#include <memory>

#include "engine/base/clock.h"
#include "engine/cameras/camera_link.h"
#include "engine/cameras/camera_source.h"
#include "engine/cameras/device_options.h"
#include "engine/cameras/file/media_reader.h"

namespace helical {

/// A recording in a camera's place: a video at its own rate, a folder of images at the rig's. Its first frame is exposed
/// when the flight's clock begins, so that the files of a rig run in step. Frames for which a machine in real time is
/// too slow are lost, as a camera's are; on a simulated clock none is. The link streams while it plays, is lost after the
/// last frame, and stalls where the file turns out to be damaged: nothing comes any more. One thread.
class FileCamera final : public CameraSource {
 public:
  /// Reads the first frame. Throws Error(kInput) when there is none, or when it has another size than the rig says.
  FileCamera(CameraId camera, const std::filesystem::path& file, const DeviceOptions& options, int width, int height,
             std::shared_ptr<Clock> clock, std::shared_ptr<CameraLink> link);

  CameraId camera() const override { return camera_; }
  bool poll(Frame& frame) override;
  void wait(TimeNs deadline) override;

 private:
  bool load();
  void skipLost(TimeNs now);
  TimeNs exposure() const;
  TimeNs arrival() const { return exposure() + readout_; }

  const CameraId camera_;
  const std::filesystem::path file_;
  const TimeNs readout_;
  double rate_hz_;
  const std::shared_ptr<Clock> clock_;
  const std::shared_ptr<CameraLink> link_;
  std::unique_ptr<MediaReader> reader_;
  MediaFrame next_;  ///< in hand if `loaded_`
  bool loaded_ = false;
  bool ended_ = false;
};

}  // namespace helical
