#include "engine/simulator/field_keeper.h"

#include <algorithm>
#include <limits>

#include "engine/base/check.h"

namespace helical {
namespace {

/// Frames are lost on their way, and a client's threads may start later than its cameras.
constexpr std::uint64_t kSpareFrames = 30;
/// Another camera may yet begin, and a busy client leaves out frames.
constexpr TimeNs kLeastEmpty = 3 * kNanosecondsPerSecond / 2;
/// Without a transmitter, or with one but no cameras: they may yet come.
constexpr TimeNs kEmptyAlone = 10 * kNanosecondsPerSecond;

}  // namespace

FieldKeeper::FieldKeeper(std::size_t cameras, int background_frames)
    : frames_needed_(static_cast<std::uint64_t>(background_frames) + kSpareFrames),
      before_(cameras),
      begun_(std::numeric_limits<TimeNs>::min()) {}

bool FieldKeeper::helicopterIn(TimeNs now, std::optional<TimeNs> switched_on, std::span<const Camera> cameras) {
  HELICAL_CHECK(cameras.size() == before_.size());
  watchBegins(now, cameras);
  if (switched_on != switched_on_) {
    switched_on_ = switched_on;
    if (switched_on) {
      in_ = false;
      begun_ = now;
      for (std::size_t i = 0; i < cameras.size(); ++i) before_[i].frames = cameras[i].frames;
    }
  }
  if (in_) return in_ = switched_on_ || looked_at_;
  if (!switched_on_ || !looked_at_)
    in_ = (switched_on_ || looked_at_) && now - begun_ >= kEmptyAlone;
  else
    in_ = now - begun_ >= kLeastEmpty && everyoneHasSeen(cameras);
  return in_;
}

void FieldKeeper::watchBegins(TimeNs now, std::span<const Camera> cameras) {
  looked_at_ = false;
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    looked_at_ = looked_at_ || cameras[i].streaming;
    if (cameras[i].streaming && !before_[i].streaming) {
      begun_ = now;
      before_[i].frames = cameras[i].frames;
    }
    before_[i].streaming = cameras[i].streaming;
  }
}

bool FieldKeeper::everyoneHasSeen(std::span<const Camera> cameras) const {
  for (std::size_t i = 0; i < cameras.size(); ++i)
    if (cameras[i].streaming && cameras[i].frames - before_[i].frames < frames_needed_) return false;
  return true;
}

}  // namespace helical
