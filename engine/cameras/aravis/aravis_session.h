#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "engine/cameras/camera_link.h"
#include "engine/cameras/clock_mapping.h"
#include "engine/cameras/device_options.h"
#include "engine/cameras/frame.h"

struct _ArvBuffer;
struct _ArvChunkParser;
struct _ArvCamera;
struct _ArvStream;

namespace helical {

class AravisSession;

/// A whole frame as it lies in a buffer of the stream's. Whoever holds it gives it back to its session.
struct ReceivedFrame {
  AravisSession* session = nullptr;
  _ArvBuffer* buffer = nullptr;
  std::uint64_t id = 0;     ///< as the camera counts; 16 bits without 0 for GigE Vision
  TimeNs device_time = 0;   ///< the camera's clock
  TimeNs first_packet = 0;  ///< CLOCK_MONOTONIC, as is `arrival`
  TimeNs arrival = 0;
  ImageView image;
};

/// One connection to a camera: opened, set up, streaming, until it is given up. A camera that comes back gets a new
/// one. Control calls come from two
/// threads of its owner's at most; frames on Aravis' own thread; `giveBack` any thread.
class AravisSession {
 public:
  /// False: it is not wanted, the session takes it back. On Aravis' thread: neither blocks nor throws.
  using Sink = std::function<bool(const ReceivedFrame&)>;

  /// Opens the camera with this address or serial number, applies all settings, starts. One at a time in the process:
  /// Aravis crashes otherwise. Throws Error(kDevice), or Error(kInput) for settings that the camera does not offer.
  AravisSession(const std::string& device, const DeviceOptions& options, int width, int height, std::uint32_t number,
                Sink sink);
  /// Blocks for seconds when the camera is dead. Every frame must have been given back.
  ~AravisSession();
  AravisSession(const AravisSession&) = delete;
  AravisSession& operator=(const AravisSession&) = delete;

  /// No frame comes after this. `alive`: tells the camera to stop.
  void halt(bool alive);

  void giveBack(_ArvBuffer* buffer);
  int lent() const { return lent_.load(std::memory_order_acquire); }
  std::uint32_t number() const { return number_; }
  /// The camera dropped us, or no longer answers heartbeats.
  bool controlLost() const { return control_lost_.load(std::memory_order_relaxed); }
  /// When the last frame came, whole or not, on CLOCK_MONOTONIC; when it started, before the first one.
  TimeNs lastFrame() const { return last_frame_.load(std::memory_order_relaxed); }
  /// As the camera says; nothing for one that nothing here reads.
  std::optional<PixelFormat> format() const { return format_; }
  /// As the camera took it.
  const LightSetting& light() const { return light_; }
  std::string description() const { return description_; }

  /// Reads the camera's clock. False where it cannot be read. Blocks for seconds when the camera is dead.
  bool sampleClock(ClockSample& sample);
  bool readsClock() const { return tick_frequency_ > 0; }
  /// Read before it started; valid where its clock can be read.
  const ClockSample& firstSample() const { return first_sample_; }
  /// Exposes now, if it waits for a command.
  void trigger();
  /// Exposes when its clock reads `when`, or now, if it waits for an action.
  void act(std::optional<TimeNs> when);
  std::uint64_t resentPackets() const;
  std::uint64_t incompleteFrames() const { return incomplete_.load(std::memory_order_relaxed); }

 private:
  static void onStream(void* session, int type, _ArvBuffer* buffer);
  static void onControlLost(void* device, void* session);
  void open(const std::string& device, const DeviceOptions& options, int width, int height);
  void start(const DeviceOptions& options);
  void enlargeReceiveBuffer();
  TimeNs fromTicks(std::uint64_t ticks) const;
  TimeNs stampOf(_ArvBuffer* buffer) const;
  void receive();
  void close();

  std::string where_;
  std::uint32_t number_;
  Sink sink_;
  _ArvCamera* camera_ = nullptr;
  _ArvStream* stream_ = nullptr;
  _ArvChunkParser* chunks_ = nullptr;  ///< null: frames are stamped by their packets
  std::atomic<_ArvStream*> receiving_{nullptr};  ///< null: frames are of no use any more
  std::atomic<bool> control_lost_{false};
  std::atomic<TimeNs> last_frame_{0};
  std::atomic<int> lent_{0};
  std::atomic<std::uint64_t> incomplete_{0};
  unsigned long control_lost_handler_ = 0;
  std::optional<PixelFormat> format_;
  LightSetting light_;
  std::uint64_t tick_frequency_ = 0;  ///< 0: the clock cannot be read
  ClockSample first_sample_;
  std::string description_;
  std::string ip_;  ///< of a network camera
};

}  // namespace helical
