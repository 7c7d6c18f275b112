#pragma once

#include <vector>

#include "engine/experiments/flight_trace.h"

namespace helical::figures {

/// A stretch of time over which a marker was selected in a camera.
struct LabelRun {
  int label = 0;  ///< markers (i - 1) + j - 1 for camera i and marker j, both counted from 1
  double from_s = 0.0;
  double to_s = 0.0;
};

/// The selected image features of a flight, consecutive ticks merged: figures 8 and 11 of the paper. A tick
/// lasts until the next; the last one as long as the one before. In the order of the labels, then of time.
std::vector<LabelRun> labelRuns(const FlightTrace& trace);

}  // namespace helical::figures
