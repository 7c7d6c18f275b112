#include "engine/pipeline/picture_tap.h"

#include "engine/cameras/demosaic.h"

namespace helical {
namespace {

constexpr TimeNs kPicturePeriod = 33 * kNanosecondsPerMillisecond;
constexpr int kBackgroundPictures = 30;

}  // namespace

void PictureTap::take(const Frame& frame, const Observation& observation, const Extractor& extractor) {
  keepBackground(extractor);
  if (last_ >= 0 && frame.arrival - last_ < kPicturePeriod) return;
  last_ = frame.arrival;
  CameraPicture& picture = pictures_.back();
  picture.sequence = frame.sequence;
  picture.exposure = frame.exposure;
  picture.width = frame.image.width;
  picture.height = frame.image.height;
  picture.observation = observation;
  picture.background = background_;
  toBgr(frame.image, picture.bgr);
  pictures_.publish();
}

/// A copy that pictures share, made anew now and then: it follows the light.
void PictureTap::keepBackground(const Extractor& extractor) {
  if (!extractor.hasBackground()) {
    background_.reset();
    return;
  }
  if (background_ && ++background_age_ < kBackgroundPictures) return;
  background_age_ = 0;
  auto copy = std::make_shared<std::vector<std::uint8_t>>();
  toBgr(extractor.background(), *copy);
  background_ = std::move(copy);
}

}  // namespace helical
