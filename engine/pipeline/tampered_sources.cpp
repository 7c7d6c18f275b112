#include "engine/pipeline/tampered_sources.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace helical {
namespace {

constexpr std::uint64_t kSeed = 0x7a3b;  // the operator's own dice: no seed of a flight

Random diceOf(CameraId camera) {
  return Random(kSeed).fork(static_cast<std::uint64_t>(camera.index()));
}

}  // namespace

TamperedCamera::TamperedCamera(std::unique_ptr<CameraSource> source,
                               std::shared_ptr<TamperingChannel> channel)
    : source_(std::move(source)), channel_(std::move(channel)), random_(diceOf(source_->camera())) {
  for (float& value : noise_) value = static_cast<float>(random_.normal());
}

bool TamperedCamera::poll(Frame& frame) {
  for (;;) {
    if (!source_->poll(frame)) return false;
    channel_->take();
    const double lost = channel_->front().lost_share;
    if (lost <= 0.0 || random_.uniform() >= lost) break;
  }
  const Tampering& tampering = channel_->front();
  if (tampering.boards.count == 0 && tampering.noise_grey <= 0.0) return true;
  ImageView& image = frame.image;
  // The source's own pixels may be a device's, or the ground for its next frame.
  pixels_.assign(image.data, image.data + static_cast<std::ptrdiff_t>(image.stride) * image.height);
  image.data = pixels_.data();
  for (int i = 0; i < tampering.boards.count; ++i)
    paintBoard(tampering.boards.boards[static_cast<std::size_t>(i)], image, pixels_.data());
  if (tampering.noise_grey > 0.0) addNoise(image, tampering.noise_grey);
  return true;
}

void TamperedCamera::addNoise(const ImageView& image, double sigma) {
  const int bytes =
      image.width * (image.format == PixelFormat::kBgr8 || image.format == PixelFormat::kRgb8 ? 3 : 1);
  const auto gain = static_cast<float>(sigma);
  for (int y = 0; y < image.height; ++y) {
    std::uint8_t* row = pixels_.data() + static_cast<std::ptrdiff_t>(y) * image.stride;
    std::size_t at = random_.bits() % kNoiseLength;
    for (int x = 0; x < bytes; ++x) {
      row[x] = static_cast<std::uint8_t>(
          std::clamp(std::lround(static_cast<float>(row[x]) + gain * noise_[at]), 0L, 255L));
      if (++at == kNoiseLength) at = 0;
    }
  }
}

TamperedObserver::TamperedObserver(std::unique_ptr<ObservationSource> source,
                                   std::shared_ptr<TamperingChannel> channel)
    : source_(std::move(source)), channel_(std::move(channel)), random_(diceOf(source_->camera())) {}

bool TamperedObserver::poll(Observation& observation) {
  for (;;) {
    if (!source_->poll(observation)) return false;
    channel_->take();
    const double lost = channel_->front().lost_share;
    if (lost <= 0.0 || random_.uniform() >= lost) break;
  }
  const Tampering& tampering = channel_->front();
  const auto begin = observation.centroids.begin();
  if (tampering.boards.count > 0) {
    const auto seen = std::remove_if(begin, begin + observation.count, [&](const Centroid& centroid) {
      return tampering.boards.covers(centroid.pixel);
    });
    observation.count = static_cast<int>(seen - begin);
  }
  if (tampering.noise_px > 0.0)
    std::for_each(begin, begin + observation.count, [&](Centroid& centroid) {
      centroid.pixel += tampering.noise_px * Eigen::Vector2d(random_.normal(), random_.normal());
    });
  return true;
}

}  // namespace helical
