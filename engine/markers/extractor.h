#pragma once

#include <cstdint>
#include <memory>

#include "engine/cameras/frame.h"
#include "engine/markers/ball_prediction.h"
#include "engine/markers/ignored_areas.h"
#include "engine/markers/marker_colours.h"
#include "engine/markers/marker_options.h"
#include "engine/markers/observation.h"

namespace helical {

/// The paper's section IV.B: background difference, colour range in HSV, opening, closing, labelling, centre
/// of gravity. Gives the same centroids as `ReferenceExtractor`, which does these steps one by one with
/// OpenCV; this one classifies every pixel by table in one pass and does the rest only around what it found.
/// Then the background follows the light, a few rows a frame, away from what was found. Allocates on the first
/// frame of a size only. One thread.
class Extractor {
 public:
  explicit Extractor(const MarkerOptions& options);
  ~Extractor();
  Extractor(Extractor&&) noexcept;
  Extractor& operator=(Extractor&&) noexcept;

  /// Before the first frame: builds what frames of this format need, which takes a tenth of a second; otherwise the
  /// first one does.
  void prepare(PixelFormat format);

  /// Averages the next `background_frames` frames into a new background; until then nothing is found.
  void takeBackground();
  /// Uses this image as background.
  void setBackground(const ImageView& image);
  /// Works without background difference: colour alone.
  void disableBackground();
  bool hasBackground() const;
  /// The averaged or given background, rows packed; only while there is one.
  ImageView background() const;

  /// From the next frame on nothing is looked for there. Allocates.
  void setIgnoredAreas(const IgnoredAreas& areas);
  /// From the next frame on these colours instead of the options'. Allocates.
  void setColours(const MarkerColours& colours);

  /// Until the next call, frames whose exposure is near these predictions are read where the balls should be;
  /// as a whole every `whole_every` frames, and at once where one of them is missed.
  void expect(const BallPredictions& predictions);
  /// Whether the last frame was read as a whole.
  bool readWhole() const;

  /// Fills `observation`'s centroids, count and truncated; largest regions first.
  /// Its exposure is the frame's.
  void extract(const ImageView& image, Observation& observation);

 private:
  struct Workspace;
  std::unique_ptr<Workspace> workspace_;
};

}  // namespace helical
