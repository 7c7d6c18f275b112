#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/base/ids.h"
#include "engine/calibration/extrinsic_calibrator.h"

namespace helical {

/// A CalibrationFrame that owns its pixels.
struct StoredFrame {
  RigidTransform world_from_body;
  Matrix6d pose_covariance = Matrix6d::Zero();
  int count = 0;
  std::array<LabelledPixel, kMaxMarkers> pixels{};
};

StoredFrame stored(const CalibrationFrame& frame);

/// A bounded memory of frames. When it is full, the frame whose helicopter pose differs least from those
/// before and after it makes room: minutes on the ground do not push out seconds of flight, and a pose that
/// only one frame has stays. Allocates at construction only.
class FrameStore {
 public:
  explicit FrameStore(int capacity);

  void clear();
  void add(const CalibrationFrame& frame);

  /// In the order of time; valid until the next call.
  std::span<const StoredFrame* const> frames() const { return order_; }
  /// Spread over all frames: at most `most` of them, written to `selection`, which is returned shortened.
  std::span<const StoredFrame* const> spread(std::span<const StoredFrame*> selection) const;

 private:
  double distance(std::size_t earlier, std::size_t later) const;
  std::size_t takeMostRedundant();

  std::size_t capacity_;
  std::vector<StoredFrame> slots_;
  std::vector<const StoredFrame*> order_;
  std::vector<double> gap_;  ///< of frame i to i - 1
};

}  // namespace helical
