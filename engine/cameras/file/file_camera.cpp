#include "engine/cameras/file/file_camera.h"

#include <algorithm>
#include <string>
#include <utility>

#include "engine/base/error.h"
#include "engine/base/log.h"

namespace helical {
namespace {

constexpr double kBufferedFrames = 3.0;

std::string sizeName(int width, int height) {
  return std::to_string(width) + "x" + std::to_string(height);
}

}  // namespace

FileCamera::FileCamera(CameraId camera, const std::filesystem::path& file, const DeviceOptions& options, int width,
                       int height, std::shared_ptr<Clock> clock, std::shared_ptr<CameraLink> link)
    : camera_(camera),
      file_(file),
      readout_(fromSeconds(1e-3 * options.readout_ms)),
      rate_hz_(options.rate_hz),
      clock_(std::move(clock)),
      link_(std::move(link)),
      reader_(MediaReader::open(file)) {
  if (!reader_->next(next_))
    throw Error(ErrorKind::kInput, "the file holds no frame", file.string(), "give a video or a folder of images");
  loaded_ = true;
  if (reader_->rate() > 0.0) rate_hz_ = reader_->rate();
  link_->state = LinkState::kStreaming;
  if (next_.bgr.width != width || next_.bgr.height != height)
    throw Error(ErrorKind::kInput,
                "the file has " + sizeName(next_.bgr.width, next_.bgr.height) + " pixels, its camera in the rig " +
                    sizeName(width, height),
                file.string(), "give the file that this camera has taken, or correct the camera's size and intrinsics");
}

TimeNs FileCamera::exposure() const {
  return fromSeconds(next_.time_s.value_or(next_.index / rate_hz_));
}

bool FileCamera::load() {
  if (loaded_ || ended_) return loaded_;
  try {
    loaded_ = reader_->next(next_);
    if (!loaded_) {
      log(LogLevel::kInfo, file_.string() + ": ended after " + std::to_string(next_.index + 1) + " frames");
      link_->state = LinkState::kLost;
    }
  } catch (const Error& error) {
    log(LogLevel::kError, error.where() + ": " + error.problem() + "; cure: " + error.cure());
    link_->state = LinkState::kStalled;
  }
  ended_ = !loaded_;
  return loaded_;
}

void FileCamera::skipLost(TimeNs now) {
  const TimeNs oldest = now - fromSeconds(kBufferedFrames / rate_hz_);
  while (load() && arrival() < oldest) loaded_ = false;
}

void FileCamera::wait(TimeNs deadline) {
  // Decodes ahead, so that the frame is there when it arrives.
  const bool more = load();
  clock_->sleepUntil(more ? std::min(deadline, arrival()) : deadline);
}

bool FileCamera::poll(Frame& frame) {
  const TimeNs now = clock_->now();
  skipLost(now);
  if (!loaded_ || now < arrival()) return false;
  frame = {camera_, static_cast<std::uint64_t>(next_.index), exposure(), arrival(), next_.bgr, 0, 0};
  loaded_ = false;  // its pixels stay until the next one is read
  return true;
}

}  // namespace helical
