#include "engine/session/frame_queue.h"

#include <algorithm>
#include <cstring>

namespace helical {
namespace {

constexpr std::size_t kMostBytes = 64u << 20;
constexpr std::size_t kFewestSlots = 4,
                      kMostSlots = 60;  // a second, where a disk or a busy machine takes its time

}  // namespace

FrameQueue::FrameQueue(const ImageRecording& recording, int width, int height)
    : recording_(recording),
      image_bytes_(
          std::max<std::size_t>(1, 3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height))) {
  setOpen(recording.at_once);
}

void FrameQueue::setOpen(bool open) {
  if (recording_.quality == ImageQuality::kOff) return;
  if (open && slots_.empty()) {
    slots_.resize(std::clamp(kMostBytes / image_bytes_, kFewestSlots, kMostSlots));
    for (RecordedFrame& slot : slots_) slot.pixels.resize(image_bytes_);
  }
  open_.store(open, std::memory_order_release);
}

bool FrameQueue::wants(const Frame& frame) {
  if (!open_.load(std::memory_order_acquire)) return false;
  if (recording_.rate_hz <= 0.0) return true;
  if (frame.exposure < due_) return false;
  const TimeNs period = fromSeconds(1.0 / recording_.rate_hz);
  due_ = std::max(due_ + period, frame.exposure + period / 2);
  return true;
}

bool FrameQueue::push(const Frame& frame) {
  const std::size_t head = head_.load(std::memory_order_relaxed);
  if (head - tail_.load(std::memory_order_acquire) == slots_.size()) return false;
  RecordedFrame& slot = slots_[head % slots_.size()];
  slot.exposure = frame.exposure;
  slot.arrival = frame.arrival;
  slot.width = frame.image.width;
  slot.height = frame.image.height;
  slot.format = frame.image.format;
  const auto row_bytes = static_cast<std::size_t>(frame.image.width * bytesPerPixel(frame.image.format));
  slot.pixels.resize(row_bytes * static_cast<std::size_t>(frame.image.height));
  for (int y = 0; y < frame.image.height; ++y)
    std::memcpy(slot.pixels.data() + row_bytes * static_cast<std::size_t>(y), frame.image.row(y), row_bytes);
  head_.store(head + 1, std::memory_order_release);
  return true;
}

const RecordedFrame* FrameQueue::front() const {
  const std::size_t tail = tail_.load(std::memory_order_relaxed);
  if (tail == head_.load(std::memory_order_acquire)) return nullptr;
  return &slots_[tail % slots_.size()];
}

void FrameQueue::pop() {
  tail_.store(tail_.load(std::memory_order_relaxed) + 1, std::memory_order_release);
}

}  // namespace helical
