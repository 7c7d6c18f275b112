#pragma once

#include <array>
#include <atomic>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <semaphore>
#include <string>
#include <thread>
#include <vector>

#include "engine/base/clock.h"
#include "engine/base/spsc_queue.h"
#include "engine/cameras/camera_link.h"
#include "engine/cameras/camera_source.h"
#include "engine/cameras/device_options.h"
#include "engine/cameras/video/video_capture.h"

namespace helical {

/// A webcam (V4L2). Frames are stamped when the driver had them, or when they arrived where it does not tell, less the
/// rig's `readout_ms`: a webcam has no clock to read. A camera that falls silent or is unplugged is looked for by a
/// thread of its own until it is back, and then gets all its settings again; what happens stands in the link. What a
/// webcam loses inside nobody tells: gaps in the sequence are returns, and frames that nobody fetched in time. One
/// thread polls and waits.
class WebcamCamera final : public CameraSource {
 public:
  using CaptureMaker = std::function<std::unique_ptr<VideoCapture>()>;

  /// `device`: "/dev/video0". Opens the camera; throws Error(kDevice) when it is not there or somebody else has it,
  /// Error(kInput) when it does not offer what the options ask for.
  WebcamCamera(CameraId camera, const std::string& device, const DeviceOptions& options, int width, int height,
               std::shared_ptr<Clock> clock, std::shared_ptr<CameraLink> link, CaptureMaker make = makeVideoCapture);
  ~WebcamCamera() override;

  CameraId camera() const override { return camera_; }
  std::optional<PixelFormat> format() const override { return PixelFormat::kBgr8; }
  bool poll(Frame& frame) override;
  void wait(TimeNs deadline) override;

 private:
  struct Picture {
    std::vector<std::uint8_t> bgr;
    int width = 0;
    int height = 0;
    std::uint64_t sequence = 0;
    TimeNs stamp = 0;    ///< by the driver or, like `arrival`, by us; CLOCK_MONOTONIC
    TimeNs arrival = 0;
  };
  static constexpr std::size_t kPictures = 8;

  // Reading thread.
  void read(const std::stop_token& stop);
  void deliver(const ImageView& bgr);
  void drop();
  bool lookAgain();
  void nap(const std::stop_token& stop);
  std::unique_ptr<VideoCapture> open() const;
  // Polling thread.
  bool take(int& picture);
  void watch();

  const CameraId camera_;
  const std::string device_;
  const DeviceOptions options_;
  const int width_;
  const int height_;
  const std::shared_ptr<Clock> clock_;
  const std::shared_ptr<CameraLink> link_;
  const CaptureMaker make_;

  std::array<Picture, kPictures> pictures_;
  SpscQueue<int, kPictures> free_;   ///< pictures that the reading thread may fill
  SpscQueue<int, kPictures> ready_;  ///< pictures to be polled
  std::counting_semaphore<> arrived_{0};
  std::atomic<TimeNs> last_frame_;   ///< CLOCK_MONOTONIC

  int held_ = -1;  ///< polling thread

  std::unique_ptr<VideoCapture> capture_;  ///< reading thread, as the next two
  std::uint64_t sequence_ = 0;
  TimeNs backoff_ = 0;

  std::mutex mutex_;
  std::condition_variable_any stopped_;
  std::jthread reader_;
};

}  // namespace helical
