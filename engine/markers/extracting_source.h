#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "engine/cameras/camera_source.h"
#include "engine/geometry/camera_model.h"
#include "engine/markers/extractor_orders.h"

namespace helical {

/// A camera with its extractor: an ObservationSource that runs on the camera's capture thread.
class ExtractingSource final : public ObservationSource {
 public:
  /// `on_frame`, if given, sees every frame with what was found in it and by what (for display), on the
  /// capture thread.
  using FrameTap = std::function<void(const Frame&, const Observation&, const Extractor&)>;

  /// `orders`, if given, are carried out from frame to frame. With a `lens`, centroids are where the balls'
  /// centres are seen, not the centres of their outlines. Takes a tenth of a second where the source
  /// knows its format: its first frame is not read later than any other.
  ExtractingSource(std::unique_ptr<CameraSource> source, const MarkerOptions& options, FrameTap on_frame = {},
                   std::shared_ptr<ExtractorOrders> orders = nullptr,
                   const std::optional<CameraModel>& lens = std::nullopt);

  CameraId camera() const override { return source_->camera(); }
  bool poll(Observation& observation) override;
  void wait(TimeNs deadline) override { source_->wait(deadline); }

 private:
  std::unique_ptr<CameraSource> source_;
  Extractor extractor_;
  FrameTap on_frame_;
  std::shared_ptr<ExtractorOrders> orders_;
  std::optional<CameraModel> lens_;
};

}  // namespace helical
