#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "engine/base/clock.h"
#include "engine/base/spsc_queue.h"
#include "engine/pipeline/flight_tap.h"
#include "engine/session/flight_item.h"
#include "engine/session/frame_queue.h"
#include "engine/session/session_writer.h"

namespace helical {

/// Records a flight without ever being in its way: the flight thread leaves copies in a bounded queue, a
/// thread of its own writes them. Chunks reach the disk every 250 ms at the latest. When the disk refuses,
/// the flight goes on without a record, and `failure` says why.
class Recorder final : public FlightTap {
 public:
  enum class WhenFull {
    kDrop,  ///< in real time: what does not fit is counted and lost
    kWait,  ///< in lock step: simulated time waits for the disk
  };

  enum class WhenRefused {
    kThrow,
    kFlyOn,  ///< as if the disk had refused later: the record has failed from the begin
  };

  /// Opens the file. Throws Error when that fails, unless told otherwise.
  Recorder(const std::filesystem::path& file, const SessionSettings& settings, WhenFull when_full,
           WhenRefused when_refused = WhenRefused::kThrow);
  ~Recorder() override;  ///< finishes
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  // Flight thread.
  void onObservation(const Observation& observation, TimeNs now, const CameraTrack& track) override;
  void onTick(const OperatorCommands& commands, const EngineSnapshot& state) override;
  void onHidden(CameraId camera, bool hidden, TimeNs now) override;
  void onCalibration(CameraId camera, const char* method, std::uint64_t seed, TimeNs now) override;
  void onCalibrationOrder(const CalibrationOrder& order, TimeNs now) override;
  void onChange(const std::shared_ptr<const FlightChange>& change, TimeNs now) override;
  void onEvent(const EngineEvent& event) override;
  void onBelief(CameraId camera, const CalibrationView& belief, TimeNs now) override;
  RecordHealth health() const override;

  // The camera's capture thread.
  void onFrame(const Frame& frame, const Observation& observation) override;

  /// From now on images of every camera to which the settings give a quality, or no more; the first time
  /// takes their memory. Any one thread.
  void recordImages(bool on);

  /// After the flight: writes what is left and closes the file.
  void finish();

  /// Any thread.
  std::uint64_t lost() const { return lost_.load(std::memory_order_relaxed); }
  std::uint64_t lostImages() const { return lost_images_.load(std::memory_order_relaxed); }
  bool recordsImages() const { return images_.load(std::memory_order_relaxed) && !failed(); }
  bool failed() const { return failed_.load(std::memory_order_acquire); }
  /// Why the record is cut off; once `failed`.
  const std::string& failure() const { return failure_; }

 private:
  using Queue = SpscQueue<FlightItem, 1024>;
  void push();
  void run();
  bool writeItems(TimeNs until);
  bool writeFrames();
  void attempt(const std::function<void()>& step);

  std::filesystem::path folder_;
  std::unique_ptr<SessionWriter> writer_;
  WhenFull when_full_;
  std::unique_ptr<Queue> queue_ = std::make_unique<Queue>();
  std::vector<std::unique_ptr<FrameQueue>> frames_;  ///< by camera
  FlightItem next_;                                  ///< flight thread
  std::atomic<bool> images_{false};                  ///< are recorded
  std::atomic<std::uint64_t> lost_{0}, lost_images_{0};
  std::atomic<bool> failed_{false};
  std::atomic<bool> losing_{false};  ///< the newest item did not fit
  std::atomic<double> disk_free_gb_;
  MonotonicClock clock_;
  std::unique_ptr<FlightItem> item_ = std::make_unique<FlightItem>();  ///< writing thread
  std::string failure_;                                                ///< writing thread, before `failed_`
  std::atomic<bool> ended_{false};
  std::thread thread_;
};

}  // namespace helical
