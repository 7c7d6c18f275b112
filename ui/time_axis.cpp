#include "ui/time_axis.h"

#include <algorithm>

namespace helical {

void TimeAxis::advance(double oldest, double now) {
  oldest_ = oldest;
  now_ = now;
  if (live_) end_ = std::max(now_, span_);
}

void TimeAxis::setLive(bool live) {
  if (live == live_) return;
  live_ = live;
  if (live_) end_ = std::max(now_, span_);
  Q_EMIT liveChanged(live_);
  Q_EMIT changed();
}

void TimeAxis::place(double end) {
  const double newest = std::max(now_, span_);
  end_ = std::clamp(end, std::min(oldest_ + span_, newest), newest);
  const bool live = end_ >= newest;
  if (live != live_) {
    live_ = live;
    Q_EMIT liveChanged(live_);
  }
  Q_EMIT changed();
}

void TimeAxis::scroll(double seconds) {
  place(end_ + seconds);
}

void TimeAxis::zoom(double factor, double about) {
  const double span = std::clamp(span_ * factor, kShortest, kLongest);
  // Following, the newest tick stays where it is; else the time under the pointer does.
  const double end = live_ ? now_ : about + (end_ - about) * span / span_;
  span_ = span;
  if (live_) {
    end_ = std::max(now_, span_);
    Q_EMIT changed();
  } else {
    place(end);
  }
}

}  // namespace helical
