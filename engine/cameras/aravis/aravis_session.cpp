#include "engine/cameras/aravis/aravis_session.h"

#include <arv.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <cstdio>
#include <mutex>
#include <utility>

#include "engine/base/error.h"
#include "engine/base/monotonic.h"
#include "engine/base/thread_priority.h"
#include "engine/cameras/aravis/aravis_error.h"
#include "engine/cameras/aravis/aravis_settings.h"
#include "engine/cameras/aravis/gvcp_action.h"
#include "engine/cameras/aravis/gvcp_probe.h"

namespace helical {
namespace {

constexpr int kBuffers = 16;
constexpr int kReceiveBuffer = 8 << 20;
constexpr std::uint64_t kTimestampControl = 0x0944, kTimestampHigh = 0x0948, kTimestampLow = 0x094c;
constexpr std::uint32_t kLatch = 2;

/// Aravis 0.8.26 crashes when cameras are opened by several threads at once (its issues 159, 164).
std::mutex& openingMutex() {
  static std::mutex mutex;
  return mutex;
}

ArvDevice* openDevice(const std::string& device, AravisError& error) {
  if (isIpAddress(device))
    return arv_interface_open_device(arv_gv_interface_get_instance(), device.c_str(), error.slot());
  return arv_open_device(device.c_str(), error.slot());  // looks for it, which takes a second
}

}  // namespace

AravisSession::AravisSession(const std::string& device, const DeviceOptions& options, int width, int height,
                             std::uint32_t number, Sink sink)
    : where_("aravis:" + device), number_(number), sink_(std::move(sink)) {
  try {
    open(device, options, width, height);
    start(options);
  } catch (...) {
    close();
    throw;
  }
}

AravisSession::~AravisSession() {
  halt(false);
  close();
}

void AravisSession::close() {
  if (camera_ != nullptr && control_lost_handler_ != 0)
    g_signal_handler_disconnect(arv_camera_get_device(camera_), control_lost_handler_);
  control_lost_handler_ = 0;
  g_clear_object(&stream_);
  g_clear_object(&chunks_);
  g_clear_object(&camera_);
}

void AravisSession::open(const std::string& device, const DeviceOptions& options, int width, int height) {
  AravisError error;
  {
    const std::lock_guard lock(openingMutex());
    ArvDevice* opened = openDevice(device, error);
    if (opened == nullptr)
      throw Error(ErrorKind::kDevice, "no camera answers: " + error.text(), where_,
                  "check its power, cable and address; `helical devices` lists what is there");
    camera_ = arv_camera_new_with_device(opened, error.slot());
    g_object_unref(opened);
    error.check("opening", where_);
  }
  ArvDevice* const opened = arv_camera_get_device(camera_);
  if (arv_camera_is_gv_device(camera_) != 0 && arv_gv_device_is_controller(ARV_GV_DEVICE(opened)) == 0)
    throw Error(ErrorKind::kDevice, "another program or host controls the camera", where_,
                "end the other one; after a crash it takes 3 seconds until the camera is free");
  arv_camera_stop_acquisition(camera_, nullptr);  // it may still send to a client that died
  applySettings(camera_, options, width, height, where_);
  PixelFormat format{};
  if (toPixelFormat(arv_camera_get_pixel_format(camera_, nullptr), format)) format_ = format;
  light_ = lightOf(camera_);
  if (arv_camera_is_gv_device(camera_) != 0) {
    tick_frequency_ = arv_gv_device_get_timestamp_tick_frequency(ARV_GV_DEVICE(opened), nullptr);
    if (tick_frequency_ > 0 && !sampleClock(first_sample_)) tick_frequency_ = 0;
    GSocketAddress* const address = arv_gv_device_get_device_address(ARV_GV_DEVICE(opened));
    char* const ip = g_inet_address_to_string(g_inet_socket_address_get_address(G_INET_SOCKET_ADDRESS(address)));
    ip_ = ip;
    g_free(ip);
  }
  if (arv_device_is_feature_available(opened, "ChunkTimestamp", nullptr) != 0)
    chunks_ = arv_camera_create_chunk_parser(camera_);
  const char* const model = arv_camera_get_model_name(camera_, nullptr);
  const char* const serial = arv_camera_get_device_serial_number(camera_, nullptr);
  description_ = std::string(model != nullptr ? model : "camera") + " " + (serial != nullptr ? serial : "");
}

void AravisSession::start(const DeviceOptions& options) {
  AravisError error;
  const auto callback = [](void* self, ArvStreamCallbackType type, ArvBuffer* buffer) {
    onStream(self, type, buffer);
  };
  const guint payload = arv_camera_get_payload(camera_, error.slot());
  error.check("asking for the size of a frame", where_);
  stream_ = arv_camera_create_stream(camera_, callback, this, error.slot());
  error.check("opening the stream", where_);
  if (ARV_IS_GV_STREAM(stream_)) {
    g_object_set(stream_, "socket-buffer", ARV_GV_STREAM_SOCKET_BUFFER_FIXED, "socket-buffer-size", kReceiveBuffer,
                 "packet-resend", options.packet_resend ? ARV_GV_STREAM_PACKET_RESEND_ALWAYS
                                                        : ARV_GV_STREAM_PACKET_RESEND_NEVER,
                 "initial-packet-timeout", 1000U, "packet-timeout", 2000U, "frame-retention",
                 static_cast<guint>(1e3 * options.frame_retention_ms), nullptr);
    enlargeReceiveBuffer();
  }
  for (int i = 0; i < kBuffers; ++i) arv_stream_push_buffer(stream_, arv_buffer_new_allocate(payload));
  control_lost_handler_ =
      g_signal_connect(arv_camera_get_device(camera_), "control-lost", G_CALLBACK(&onControlLost), this);
  last_frame_ = monotonicNow();
  receiving_ = stream_;
  arv_camera_start_acquisition(camera_, error.slot());
  if (error) halt(false);
  error.check("starting", where_);
}

/// Aravis does it itself only when the first frame has begun to arrive, and overflowed the default.
void AravisSession::enlargeReceiveBuffer() {
  const std::uint16_t port = arv_gv_stream_get_port(ARV_GV_STREAM(stream_));
  constexpr int kDescriptors = 1024;
  for (int descriptor = 3; descriptor < kDescriptors; ++descriptor) {
    sockaddr_in address{};
    socklen_t length = sizeof address;
    if (getsockname(descriptor, reinterpret_cast<sockaddr*>(&address), &length) != 0) continue;
    if (address.sin_family != AF_INET || ntohs(address.sin_port) != port) continue;
    int kind = 0;
    socklen_t size = sizeof kind;
    getsockopt(descriptor, SOL_SOCKET, SO_TYPE, &kind, &size);
    if (kind == SOCK_DGRAM) setsockopt(descriptor, SOL_SOCKET, SO_RCVBUF, &kReceiveBuffer, sizeof kReceiveBuffer);
  }
}

void AravisSession::onStream(void* session, int type, ArvBuffer* /*buffer*/) {
  if (type == ARV_STREAM_CALLBACK_TYPE_INIT)
    raisePriority(Urgency::kCapture);
  else if (type == ARV_STREAM_CALLBACK_TYPE_BUFFER_DONE)
    static_cast<AravisSession*>(session)->receive();
}

void AravisSession::onControlLost(void* /*device*/, void* session) {
  static_cast<AravisSession*>(session)->control_lost_ = true;
}

void AravisSession::receive() {
  ArvStream* const stream = receiving_.load(std::memory_order_acquire);
  if (stream == nullptr) return;
  ArvBuffer* const buffer = arv_stream_try_pop_buffer(stream);
  if (buffer == nullptr) return;
  ReceivedFrame frame;
  frame.arrival = monotonicNow();
  last_frame_.store(frame.arrival, std::memory_order_relaxed);
  if (arv_buffer_get_status(buffer) != ARV_BUFFER_STATUS_SUCCESS ||
      !toPixelFormat(arv_buffer_get_image_pixel_format(buffer), frame.image.format)) {
    incomplete_.fetch_add(1, std::memory_order_relaxed);
    arv_stream_push_buffer(stream, buffer);
    return;
  }
  frame.session = this;
  frame.buffer = buffer;
  frame.id = arv_buffer_get_frame_id(buffer);
  frame.device_time = stampOf(buffer);
  frame.first_packet = frame.arrival - (worldNow() - static_cast<TimeNs>(arv_buffer_get_system_timestamp(buffer)));
  std::size_t size = 0;
  frame.image.data = static_cast<const std::uint8_t*>(arv_buffer_get_data(buffer, &size));
  frame.image.width = arv_buffer_get_image_width(buffer);
  frame.image.height = arv_buffer_get_image_height(buffer);
  frame.image.stride = frame.image.width * bytesPerPixel(frame.image.format);
  lent_.fetch_add(1, std::memory_order_acq_rel);
  if (!sink_(frame)) giveBack(buffer);
}

void AravisSession::giveBack(ArvBuffer* buffer) {
  arv_stream_push_buffer(stream_, buffer);
  lent_.fetch_sub(1, std::memory_order_acq_rel);
}

void AravisSession::halt(bool alive) {
  if (stream_ == nullptr || receiving_.load() == nullptr) return;
  if (alive) arv_camera_stop_acquisition(camera_, nullptr);
  arv_stream_stop_thread(stream_, FALSE);  // returns when the last callback has
  receiving_ = nullptr;
  arv_stream_start_thread(stream_);  // its end insists on a running thread
}

/// USB3 Vision counts nanoseconds.
TimeNs AravisSession::fromTicks(std::uint64_t ticks) const {
  if (tick_frequency_ == 0 || tick_frequency_ == static_cast<std::uint64_t>(kNanosecondsPerSecond))
    return static_cast<TimeNs>(ticks);
  return static_cast<TimeNs>(static_cast<double>(kNanosecondsPerSecond) / static_cast<double>(tick_frequency_) *
                             static_cast<double>(ticks));
}

TimeNs AravisSession::stampOf(ArvBuffer* buffer) const {
  if (chunks_ != nullptr && arv_buffer_has_chunks(buffer) != 0) {
    const gint64 ticks = arv_chunk_parser_get_integer_value(chunks_, buffer, "ChunkTimestamp", nullptr);
    if (ticks > 0) return fromTicks(static_cast<std::uint64_t>(ticks));
  }
  return static_cast<TimeNs>(arv_buffer_get_timestamp(buffer));
}

bool AravisSession::sampleClock(ClockSample& sample) {
  if (arv_camera_is_gv_device(camera_) == 0 || tick_frequency_ == 0) return false;
  ArvDevice* const device = arv_camera_get_device(camera_);
  const TimeNs before = monotonicNow();
  if (arv_device_write_register(device, kTimestampControl, kLatch, nullptr) == 0) return false;
  const TimeNs after = monotonicNow();
  guint32 high = 0, low = 0;
  if (arv_device_read_register(device, kTimestampHigh, &high, nullptr) == 0) return false;
  if (arv_device_read_register(device, kTimestampLow, &low, nullptr) == 0) return false;
  const std::uint64_t ticks = std::uint64_t{high} << 32 | low;
  if (ticks == 0) return false;
  sample.device = fromTicks(ticks);
  sample.host = before + (after - before) / 2;
  sample.sigma = (after - before) / 2 + 1000;
  return true;
}

void AravisSession::trigger() {
  arv_camera_software_trigger(camera_, nullptr);
}

void AravisSession::act(std::optional<TimeNs> when) {
  if (!ip_.empty()) sendAction(ip_, when);
}

std::uint64_t AravisSession::resentPackets() const {
  return ARV_IS_GV_STREAM(stream_) ? arv_stream_get_info_uint64_by_name(stream_, "n_resent_packets") : 0;
}

}  // namespace helical
