#pragma once

#include <vector>

#include "engine/cameras/frame.h"
#include "engine/markers/background_model.h"
#include "engine/markers/binary_mask.h"
#include "engine/markers/marker_options.h"
#include "engine/markers/observation.h"
#include "engine/markers/region_labeller.h"

namespace helical {

/// The paper's section IV.B step by step with OpenCV, easy to check and slow: what `Extractor` is tested
/// against. One thread.
class ReferenceExtractor {
 public:
  explicit ReferenceExtractor(const MarkerOptions& options);

  void takeBackground() { background_.take(); }
  void setBackground(const ImageView& image) { background_.set(image); }
  void disableBackground() { background_.disable(); }
  bool hasBackground() const { return background_.state() == BackgroundModel::State::kReady; }

  /// As `Extractor::extract` with the binary estimator, with the same centroids in the same order.
  void extract(const ImageView& image, Observation& observation);

 private:
  MarkerOptions options_;
  BackgroundModel background_;
};

/// The steps of one colour: regions, and the mask they are regions of. `background` may be null.
std::vector<Region> referenceRegions(const ImageView& image, const ImageView* background,
                                     const ColourRange& colour, const MarkerOptions& options,
                                     const BinaryMask* ignored = nullptr, BinaryMask* mask = nullptr);

}  // namespace helical
