#pragma once

#include <functional>
#include <memory>

#include "engine/cameras/camera_source.h"
#include "engine/markers/extraction_orders.h"
#include "engine/markers/extractor.h"

namespace helical {

/// A camera with its extractor: an ObservationSource that runs on the camera's capture thread.
class ExtractingSource final : public ObservationSource {
 public:
  /// `on_frame`, if given, sees every frame with what was found in it and by what (for display), on the
  /// capture thread.
  using FrameTap = std::function<void(const Frame&, const Observation&, const Extractor&)>;

  /// `orders` may be missing.
  ExtractingSource(std::unique_ptr<CameraSource> source, const MarkerOptions& options, FrameTap on_frame = {},
                   std::shared_ptr<ExtractionChannel> orders = {});

  CameraId camera() const override { return source_->camera(); }
  bool poll(Observation& observation) override;
  void wait(TimeNs deadline) override { source_->wait(deadline); }

 private:
  std::unique_ptr<CameraSource> source_;
  void obey();

  MarkerOptions options_;
  Extractor extractor_;
  FrameTap on_frame_;
  std::shared_ptr<ExtractionChannel> orders_;
  ExtractionOrders obeyed_;
};

}  // namespace helical
