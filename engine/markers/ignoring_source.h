#pragma once

#include <memory>

#include "engine/markers/extractor_orders.h"
#include "engine/markers/observation.h"

namespace helical {

/// A source without images: centroids in areas that are to be ignored are left out, as an extractor would.
class IgnoringSource final : public ObservationSource {
 public:
  IgnoringSource(std::unique_ptr<ObservationSource> source, std::shared_ptr<ExtractorOrders> orders);

  CameraId camera() const override { return source_->camera(); }
  bool poll(Observation& observation) override;
  void wait(TimeNs deadline) override { source_->wait(deadline); }

 private:
  std::unique_ptr<ObservationSource> source_;
  std::shared_ptr<ExtractorOrders> orders_;
};

}  // namespace helical
