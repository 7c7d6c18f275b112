#include "engine/cameras/webcam/webcam_camera.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <utility>

#include "engine/base/error.h"
#include "engine/base/log.h"
#include "engine/base/monotonic.h"
#include "engine/base/thread_priority.h"
#include "engine/cameras/camera_silence.h"
#include "engine/cameras/webcam/webcam_settings.h"

namespace helical {
namespace {

constexpr TimeNs kMs = kNanosecondsPerMillisecond;
constexpr TimeNs kShortestBackoff = 100 * kMs, kLongestBackoff = 400 * kMs;
constexpr TimeNs kStale = 60 * kMs;  // skipped for a newer frame
constexpr TimeNs kOldestStamp = kNanosecondsPerSecond;  // else the driver stamps by another clock

}  // namespace

WebcamCamera::WebcamCamera(CameraId camera, const std::string& device, const DeviceOptions& options, int width,
                           int height, std::shared_ptr<Clock> clock, std::shared_ptr<CameraLink> link,
                           CaptureMaker make)
    : camera_(camera),
      device_(device),
      options_(options),
      width_(width),
      height_(height),
      clock_(std::move(clock)),
      link_(std::move(link)),
      make_(std::move(make)),
      last_frame_(monotonicNow()) {
  validate(options_);
  for (std::size_t i = 0; i < kPictures; ++i) free_.push(static_cast<int>(i));
  capture_ = open();
  last_frame_ = monotonicNow();
  link_->state = LinkState::kStreaming;
  reader_ = std::jthread([this](const std::stop_token& stop) { read(stop); });
}

WebcamCamera::~WebcamCamera() = default;

std::unique_ptr<VideoCapture> WebcamCamera::open() const {
  const std::string where = "webcam:" + device_;
  auto capture = make_();
  if (!capture->openDevice(device_)) {
    if (access(device_.c_str(), F_OK) != 0)
      throw Error(ErrorKind::kDevice, "there is no such webcam", where,
                  "plug it in; `helical devices` lists what is there");
    if (access(device_.c_str(), R_OK | W_OK) != 0)
      throw Error(ErrorKind::kDevice, std::string("the webcam may not be used: ") + std::strerror(errno), where,
                  "sudo usermod -aG video $USER, then log in again");
    throw Error(ErrorKind::kDevice, "the webcam gives no pictures", where,
                "end the program that uses it; `helical devices` tells which nodes are cameras");
  }
  applyWebcamSettings(*capture, options_, width_, height_, where);
  link_->tell(lightOf(*capture, options_));
  return capture;
}

// ---- reading thread

void WebcamCamera::read(const std::stop_token& stop) {
  raisePriority(Urgency::kCapture);
  while (!stop.stop_requested()) {
    ImageView bgr;
    if (!capture_) {
      if (!lookAgain()) nap(stop);
    } else if (capture_->read(bgr) && bgr.width == width_ && bgr.height == height_) {
      deliver(bgr);
    } else {
      drop();
    }
  }
  capture_.reset();
}

void WebcamCamera::deliver(const ImageView& bgr) {
  const TimeNs now = monotonicNow();
  last_frame_.store(now, std::memory_order_relaxed);
  LinkState stalled = LinkState::kStalled;
  if (link_->state.compare_exchange_strong(stalled, LinkState::kStreaming)) ++link_->returns;
  ++sequence_;
  int index = 0;
  if (!free_.pop(index)) {
    link_->overrun.fetch_add(1, std::memory_order_relaxed);
    return;
  }
  Picture& picture = pictures_[static_cast<std::size_t>(index)];
  const auto row = static_cast<std::size_t>(3 * bgr.width);
  picture.bgr.resize(row * static_cast<std::size_t>(bgr.height));
  for (int y = 0; y < bgr.height; ++y)
    std::copy_n(bgr.row(y), row, picture.bgr.data() + static_cast<std::size_t>(y) * row);
  picture.width = bgr.width;
  picture.height = bgr.height;
  picture.sequence = sequence_;
  picture.arrival = now;
  const TimeNs stamp = fromSeconds(1e-3 * capture_->get(VideoCapture::Property::kTimeMs));
  picture.stamp = stamp <= now && now - stamp < kOldestStamp ? stamp : now;
  ready_.push(index);
  arrived_.release();
}

void WebcamCamera::drop() {
  link_->state = LinkState::kLost;
  log(LogLevel::kWarning, "webcam:" + device_ + ": no frame any more, looks for it again");
  capture_.reset();
  backoff_ = kShortestBackoff;
}

bool WebcamCamera::lookAgain() {
  try {
    capture_ = open();
  } catch (const Error& error) {
    // A node that is there and gives nothing: somebody else was quicker.
    link_->state = access(device_.c_str(), R_OK | W_OK) == 0 ? LinkState::kTaken : LinkState::kLost;
    return false;
  }
  ++link_->returns;
  ++sequence_;  // what was lost meanwhile nobody can count
  last_frame_ = monotonicNow();
  link_->state = LinkState::kStreaming;
  log(LogLevel::kInfo, "webcam:" + device_ + ": is back");
  return true;
}

void WebcamCamera::nap(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  stopped_.wait_for(lock, stop, std::chrono::nanoseconds(backoff_), [] { return false; });
  backoff_ = std::min(kLongestBackoff, 2 * backoff_);
}

// ---- polling thread

/// The reading thread may hang in the driver meanwhile.
void WebcamCamera::watch() {
  if (monotonicNow() - last_frame_.load(std::memory_order_relaxed) <= longestSilence(options_)) return;
  LinkState streaming = LinkState::kStreaming;
  link_->state.compare_exchange_strong(streaming, LinkState::kStalled);
}

bool WebcamCamera::take(int& picture) {
  if (!ready_.pop(picture)) return false;
  int newer = 0;
  while (monotonicNow() - pictures_[static_cast<std::size_t>(picture)].arrival > kStale && ready_.pop(newer)) {
    link_->overrun.fetch_add(1, std::memory_order_relaxed);
    free_.push(picture);
    picture = newer;
  }
  return true;
}

bool WebcamCamera::poll(Frame& frame) {
  if (held_ >= 0) free_.push(held_);
  held_ = -1;
  watch();
  if (!take(held_)) return false;
  const Picture& picture = pictures_[static_cast<std::size_t>(held_)];
  const TimeNs to_clock = clock_->now() - monotonicNow();
  frame.camera = camera_;
  frame.sequence = picture.sequence;
  frame.exposure = picture.stamp + to_clock - fromSeconds(1e-3 * options_.readout_ms);
  frame.arrival = picture.arrival + to_clock;
  frame.image = {picture.bgr.data(), picture.width, picture.height, 3 * picture.width, PixelFormat::kBgr8};
  frame.first_packet = 0;
  frame.device_time = picture.stamp;
  return true;
}

void WebcamCamera::wait(TimeNs deadline) {
  const TimeNs left = deadline - clock_->now();
  if (left > 0) static_cast<void>(arrived_.try_acquire_for(std::chrono::nanoseconds(left)));
}

}  // namespace helical
