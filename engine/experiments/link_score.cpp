#include "engine/experiments/link_score.h"

#include <algorithm>

namespace helical {

void LinkScore::add(const EngineSnapshot& tick) {
  if (!rotorsTurn(tick.phase)) return;
  for (std::size_t c = 0; c < static_cast<std::size_t>(tick.camera_count); ++c) {
    const TimeNs exposure = tick.cameras[c].track.exposure;
    if (exposure == last_exposure_[c]) continue;
    if (last_exposure_[c] > 0) longest_gap_s_[c] = std::max(longest_gap_s_[c], toSeconds(exposure - last_exposure_[c]));
    last_exposure_[c] = exposure;
    if (tick.cameras[c].transfer > 0) transfer_.add(tick.cameras[c].transfer);
  }
}

}  // namespace helical
