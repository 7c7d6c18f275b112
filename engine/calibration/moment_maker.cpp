#include "engine/calibration/moment_maker.h"

#include <cstdlib>

namespace helical {
namespace {

constexpr TimeNs kWidestGap = 60 * kNanosecondsPerMillisecond;  // between the frames before and after
constexpr std::size_t kFewestBalls = 3;

}  // namespace

void MomentMaker::add(CameraId camera, const NamedBalls& balls) {
  Recent& recent = cameras_[static_cast<std::size_t>(camera.index())];
  recent.frames[static_cast<std::size_t>(recent.next)] = balls;
  recent.next = (recent.next + 1) % kKept;
  if (recent.count < kKept) ++recent.count;
}

void MomentMaker::forget() {
  for (Recent& recent : cameras_) recent.count = recent.next = 0;
}

int MomentMaker::at(TimeNs time, RigMoment& moment, std::array<const NamedBalls*, kMaxCameras>* nearest) const {
  moment.time = time;
  int count = 0;
  for (std::size_t c = 0; c < cameras_.size(); ++c) {
    RigMoment::View& view = moment.views[c];
    view.seen.reset();
    if (nearest != nullptr) (*nearest)[c] = nullptr;
    const NamedBalls *before = nullptr, *after = nullptr;
    const Recent& recent = cameras_[c];
    for (int i = 0; i < recent.count; ++i) {
      const NamedBalls& frame = recent.frames[static_cast<std::size_t>(i)];
      if (frame.exposure <= time && (before == nullptr || frame.exposure > before->exposure)) before = &frame;
      if (frame.exposure > time && (after == nullptr || frame.exposure < after->exposure)) after = &frame;
    }
    if (before == nullptr || after == nullptr || after->exposure - before->exposure > kWidestGap) continue;
    const std::bitset<kMaxMarkers> both = before->seen & after->seen;
    if (both.count() < kFewestBalls) continue;
    const float share = static_cast<float>(time - before->exposure) /
                        static_cast<float>(after->exposure - before->exposure);
    view.seen = both;
    for (std::size_t m = 0; m < kMaxMarkers; ++m)
      if (both[m]) view.pixels[m] = before->pixels[m] + share * (after->pixels[m] - before->pixels[m]);
    // Between two frames noise averages; half way it is half as large.
    view.variance = (1.0F - 2.0F * share * (1.0F - share)) * before->variance;
    if (nearest != nullptr) (*nearest)[c] = share < 0.5F ? before : after;
    ++count;
  }
  return count;
}

}  // namespace helical
