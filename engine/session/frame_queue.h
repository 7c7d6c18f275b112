#pragma once

#include <atomic>
#include <cstdint>
#include <vector>

#include "engine/cameras/frame.h"
#include "engine/session/image_recording.h"

namespace helical {

/// A frame with pixels of its own, rows without padding.
struct RecordedFrame {
  TimeNs exposure = 0;
  TimeNs arrival = 0;
  int width = 0;
  int height = 0;
  PixelFormat format = PixelFormat::kBgr8;
  std::vector<std::uint8_t> pixels;
};

/// One camera's images on their way to the disk: bounded, wait-free on both sides, with the memory for all of
/// it taken when the first one is asked for. One thread pushes, one takes, a third one decides.
class FrameQueue {
 public:
  /// For images up to `width` by `height`.
  FrameQueue(const ImageRecording& recording, int width, int height);

  /// Deciding thread: whether frames are wanted from now on. Without effect where the quality is off.
  void setOpen(bool open);
  /// Pushing thread: whether this frame is one to keep; asked once for every frame.
  bool wants(const Frame& frame);
  /// Pushing thread: false when there is no room.
  bool push(const Frame& frame);

  /// Taking thread: the oldest frame, null if there is none; `pop` makes room of it.
  const RecordedFrame* front() const;
  void pop();

 private:
  ImageRecording recording_;
  TimeNs due_ = 0;
  std::size_t image_bytes_;
  std::atomic<bool> open_{false};
  std::vector<RecordedFrame> slots_;  ///< deciding thread, before it is open for the first time
  alignas(64) std::atomic<std::size_t> head_{0};
  alignas(64) std::atomic<std::size_t> tail_{0};
};

}  // namespace helical
