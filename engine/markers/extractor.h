#pragma once

#include <cstdint>
#include <memory>

#include "engine/cameras/frame.h"
#include "engine/markers/marker_options.h"
#include "engine/markers/observation.h"

namespace helical {

/// The paper's section IV.B: background difference, colour range in HSV, opening, closing, labelling, centre
/// of gravity. Gives the same centroids as `ReferenceExtractor`, which does these steps one by one with
/// OpenCV; this one classifies every pixel by table in one pass and does the rest only around what it found.
/// Allocates on the first frame of a size only. One thread.
class Extractor {
 public:
  explicit Extractor(const MarkerOptions& options);
  ~Extractor();
  Extractor(Extractor&&) noexcept;
  Extractor& operator=(Extractor&&) noexcept;

  /// Averages the next `background_frames` frames into a new background; until then nothing is found.
  void takeBackground();
  /// Uses this image as background.
  void setBackground(const ImageView& image);
  /// Works without background difference: colour alone.
  void disableBackground();
  bool hasBackground() const;
  /// The averaged or given background, rows packed; only while there is one.
  ImageView background() const;

  /// Looks for markers of this colour from the next frame on. Prepares tables unless somebody holds those of
  /// this range already, which takes some 100 ms.
  void setColour(const ColourRange& colour);

  /// Fills `observation`'s centroids, count, truncated and extraction time; largest regions first.
  void extract(const ImageView& image, Observation& observation);

 private:
  struct Workspace;
  std::unique_ptr<Workspace> workspace_;
};

}  // namespace helical
