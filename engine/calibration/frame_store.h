#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "engine/base/ids.h"
#include "engine/calibration/extrinsic_calibrator.h"
#include "engine/calibration/thinned_store.h"

namespace helical {

/// A CalibrationFrame that owns its pixels.
struct StoredFrame {
  RigidTransform world_from_body;
  Matrix6d pose_covariance = Matrix6d::Zero();
  int count = 0;
  std::array<LabelledPixel, kMaxMarkers> pixels{};
};

StoredFrame stored(const CalibrationFrame& frame);

/// The frames to calibrate from, thinned as ThinnedStore does. Allocates at construction only.
class FrameStore {
 public:
  explicit FrameStore(int capacity) : store_(capacity) {}

  void clear() { store_.clear(); }
  void add(const CalibrationFrame& frame) { store_.add(stored(frame)); }

  /// In the order of time; valid until the next call.
  std::span<const StoredFrame* const> frames() const { return store_.frames(); }
  /// Spread over all frames: at most `most` of them, written to `selection`, which is returned shortened.
  std::span<const StoredFrame* const> spread(std::span<const StoredFrame*> selection) const;

 private:
  ThinnedStore<StoredFrame> store_;
};

}  // namespace helical
