#pragma once

#include <QImage>

#include "engine/markers/marker_options.h"
#include "engine/pipeline/snapshot.h"
#include "ui/picture_viewport.h"

namespace helical {

/// What of the extractor's decisions is shown over a picture.
struct PictureMasks {
  bool background = false;  ///< darkens what does not differ from the background
  bool colour = false;      ///< tints what has the markers' colour
  ColourRange range;
  int background_threshold = 20;
};

/// The part of a picture that `viewport` sees, scaled once to as many device pixels as it has on the screen,
/// with its masks. The masks are computed on the scaled pixels: cheap, and true to a pixel of the screen.
void scalePicture(const CameraPicture& picture, const PictureViewport& viewport, const PictureMasks& masks,
                  double device_pixel_ratio, QImage& image);

/// The colours of the ball under `pixel`: what is connected to it and much like it, widened a little. Keeps
/// the lower bounds sane; returns false where the picture is grey or there is none.
bool colourOfBall(const CameraPicture& picture, const Eigen::Vector2d& pixel, ColourRange& range);

}  // namespace helical
