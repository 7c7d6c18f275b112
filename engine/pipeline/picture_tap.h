#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "engine/base/latest_value.h"
#include "engine/cameras/frame.h"
#include "engine/markers/extractor.h"
#include "engine/pipeline/snapshot.h"

namespace helical {

/// A copy of a camera's frames at display rate, with what was found in them: `take` on the camera's capture thread,
/// `pictures` read by the thread that shows them.
class PictureTap {
 public:
  void take(const Frame& frame, const Observation& observation, const Extractor& extractor);
  LatestValue<CameraPicture>& pictures() { return pictures_; }

 private:
  void keepBackground(const Extractor& extractor);

  LatestValue<CameraPicture> pictures_;
  std::shared_ptr<const std::vector<std::uint8_t>> background_;
  int background_age_ = 0;  ///< pictures
  TimeNs last_ = -1;
};

}  // namespace helical
