#pragma once

#include "engine/markers/observation.h"
#include "engine/tracking/track.h"
#include "ui/camera_track_history.h"

class QPainter;

namespace helical {

/// What is drawn over one camera's picture. Both may be missing.
struct CameraOverlay {
  const CameraTrack* track = nullptr;        ///< of the same frame
  const Observation* observation = nullptr;  ///< every region found in it
  int marker_count = 0;
  /// Where the markers came from, if that is to be drawn.
  const CameraTrackHistory* history = nullptr;
  /// Errors are drawn so many times larger than they are.
  double magnification = 1.0;
};

/// Draws rings with marker ids (green: used for the pose; amber: named but rejected, or a region that is no
/// marker), the way the markers came, a cross where each marker should be, the ellipse of three standard
/// deviations of each centroid and an arrow from it towards the cross, both magnified. `scale` is screen
/// pixels per image pixel; the painter's origin is the picture's top left corner.
void paintOverlay(QPainter& painter, const CameraOverlay& overlay, double scale);

}  // namespace helical
