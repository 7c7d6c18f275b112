#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "engine/base/time.h"

namespace helical {

/// Whoever puts the helicopter on the field of a virtual rig. Clients take the images of the empty field that they tell
/// balls from when their cameras begin, before or after their transmitter does, and a busy machine may start one camera
/// much later than another: the helicopter comes when everyone has certainly seen the field without it. Times on any one
/// clock. One thread at a time.
class FieldKeeper {
 public:
  struct Camera {
    bool streaming = false;
    std::uint64_t frames = 0;  ///< sent so far
  };

  /// `background_frames`: that a client needs of the empty field.
  FieldKeeper(std::size_t cameras, int background_frames);

  /// Whether the helicopter is on the field from `now` on. With a transmitter, which is switched on at `switched_on`, it
  /// comes when each camera that streams has shown enough of the empty field, and stays. Without, it comes for those who
  /// only look on, later, and is taken away when nobody does.
  bool helicopterIn(TimeNs now, std::optional<TimeNs> switched_on, std::span<const Camera> cameras);

 private:
  void watchBegins(TimeNs now, std::span<const Camera> cameras);
  bool everyoneHasSeen(std::span<const Camera> cameras) const;

  const std::uint64_t frames_needed_;
  std::vector<Camera> before_;  ///< at the last call; frames: when it began, or the transmitter was switched on
  std::optional<TimeNs> switched_on_;
  TimeNs begun_;  ///< the last thing that began
  bool looked_at_ = false;
  bool in_ = false;
};

}  // namespace helical
