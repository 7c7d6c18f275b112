#pragma once

#include <condition_variable>
#include <memory>
#include <mutex>
#include <semaphore>
#include <string>
#include <thread>
#include <vector>

#include "engine/base/clock.h"
#include "engine/base/spsc_queue.h"
#include "engine/cameras/aravis/aravis_session.h"
#include "engine/cameras/camera_link.h"
#include "engine/cameras/camera_source.h"
#include "engine/cameras/clock_mapping.h"
#include "engine/cameras/device_options.h"

namespace helical {

/// A GigE Vision or USB3 Vision camera, by Aravis. Frames are views into the stream's buffers, stamped with
/// the mid-exposure on our clock. Cameras that wait for triggers by software or action get them here, all of
/// a rig at the same instants of this machine's clock, `rate_hz` times a second. A camera that falls silent,
/// is unplugged, restarts or is taken by another host is looked for by a thread of its own until it is back,
/// and then gets all its settings again; what happens stands in the link. One thread polls and waits.
class AravisCamera final : public CameraSource {
 public:
  /// `device`: address or serial number. Opens the camera; throws Error(kDevice) when it is not there, Error(kInput)
  /// when it does not offer what the options ask for.
  AravisCamera(CameraId camera, const std::string& device, const DeviceOptions& options, int width, int height,
               std::shared_ptr<Clock> clock, std::shared_ptr<CameraLink> link);
  ~AravisCamera() override;

  CameraId camera() const override { return camera_; }
  std::optional<PixelFormat> format() const override { return format_; }
  bool poll(Frame& frame) override;
  void wait(TimeNs deadline) override;

 private:
  struct NumberedSample {
    std::uint32_t session = 0;
    ClockSample sample;
  };
  // Supervising thread.
  void supervise(const std::stop_token& stop);
  void watch(const std::stop_token& stop);
  void orderExposure();
  void drop(LinkState why);
  bool lookAgain(const std::stop_token& stop);
  std::unique_ptr<AravisSession> open();
  void openFirst();
  void nap(const std::stop_token& stop, TimeNs length);
  // Keeping thread: what may block for seconds.
  void keep(const std::stop_token& stop);
  void sampleClock(AravisSession& session);
  // Polling thread.
  bool take(ReceivedFrame& received);
  void giveBack();
  void follow(const ReceivedFrame& received);
  TimeNs exposureOf(const ReceivedFrame& received);

  const CameraId camera_;
  const std::string device_;
  const DeviceOptions options_;
  const int width_;
  const int height_;
  const std::shared_ptr<Clock> clock_;
  const std::shared_ptr<CameraLink> link_;
  std::optional<PixelFormat> format_;  ///< when it was opened first

  SpscQueue<ReceivedFrame, 8> frames_;
  SpscQueue<NumberedSample, 16> samples_;
  std::counting_semaphore<> arrived_{0};

  ReceivedFrame held_;  ///< polling thread, as the next six
  ClockMapping mapping_;
  std::uint32_t session_ = 0;
  std::uint64_t last_id_ = 0;
  std::uint64_t sequence_ = 0;
  bool seen_ = false;
  NumberedSample early_;  ///< of a session whose frames have not come yet

  std::uint32_t sessions_ = 0;  ///< supervising thread, as the next two
  TimeNs backoff_ = 0;
  TimeNs next_order_ = 0;  ///< of an exposure, on CLOCK_MONOTONIC

  std::uint32_t sampled_session_ = 0;  ///< keeping thread, as the next two
  TimeNs next_sample_ = 0;
  int quick_samples_ = 0;

  /// Guards dead_, and current_ where it is changed, which the supervising thread does; the keeping thread alone ends
  /// sessions.
  std::mutex mutex_;
  std::condition_variable_any changed_;
  std::unique_ptr<AravisSession> current_;
  std::vector<std::unique_ptr<AravisSession>> dead_;
  std::jthread keeper_;
  std::jthread supervisor_;
};

}  // namespace helical
