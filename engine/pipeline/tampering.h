#pragma once

#include "engine/pipeline/white_board.h"

namespace helical {

/// What the operator does to one camera's frames before anybody looks for markers in them.
struct Tampering {
  WhiteBoards boards;
  double lost_share = 0.0;  ///< of the frames that never arrive, at random: 0 to 1
  double noise_grey = 0.0;  ///< standard deviation added to every byte of an image [grey levels]
  double noise_px = 0.0;    ///< the same for a source without images: added to each centroid, per axis [px]
};

}  // namespace helical
