#pragma once

#include <array>
#include <memory>
#include <vector>

#include "engine/base/latest_value.h"
#include "engine/base/random.h"
#include "engine/cameras/camera_source.h"
#include "engine/markers/observation.h"
#include "engine/pipeline/tampering.h"

namespace helical {

/// What is done to one camera's frames: written by the operator's thread, read by the camera's capture
/// thread.
using TamperingChannel = LatestValue<Tampering>;

/// A camera whose frames show the boards before it, are noisy or get lost, whatever kind of camera it is.
/// A lost frame is a gap in the sequence, as it is with a bad cable. Untampered frames pass untouched.
class TamperedCamera final : public CameraSource {
 public:
  TamperedCamera(std::unique_ptr<CameraSource> source, std::shared_ptr<TamperingChannel> channel);

  CameraId camera() const override { return source_->camera(); }
  std::optional<PixelFormat> format() const override { return source_->format(); }
  bool poll(Frame& frame) override;
  void wait(TimeNs deadline) override { source_->wait(deadline); }

 private:
  void addNoise(const ImageView& image, double sigma);

  static constexpr std::size_t kNoiseLength = 4099;  ///< a prime: rows do not repeat below each other

  std::unique_ptr<CameraSource> source_;
  std::shared_ptr<TamperingChannel> channel_;
  Random random_;
  std::vector<std::uint8_t> pixels_;         ///< of the newest frame that was changed
  std::array<float, kNoiseLength> noise_{};  ///< of standard deviation 1, read from another place in each row
};

/// The same for a source without images: centroids behind a board are left out, noise moves them.
class TamperedObserver final : public ObservationSource {
 public:
  TamperedObserver(std::unique_ptr<ObservationSource> source, std::shared_ptr<TamperingChannel> channel);

  CameraId camera() const override { return source_->camera(); }
  bool poll(Observation& observation) override;
  void wait(TimeNs deadline) override { source_->wait(deadline); }

 private:
  std::unique_ptr<ObservationSource> source_;
  std::shared_ptr<TamperingChannel> channel_;
  Random random_;
};

}  // namespace helical
