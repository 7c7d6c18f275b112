#include "engine/markers/extracting_source.h"

#include <utility>

namespace helical {

ExtractingSource::ExtractingSource(std::unique_ptr<CameraSource> source, const MarkerOptions& options,
                                   FrameTap on_frame, std::shared_ptr<ExtractionChannel> orders)
    : source_(std::move(source)),
      options_(options),
      extractor_(options),
      on_frame_(std::move(on_frame)),
      orders_(std::move(orders)) {}

void ExtractingSource::obey() {
  const ExtractionOrders& ordered = orders_->front();
  if (ordered.colour != obeyed_.colour) extractor_.setColour(ordered.colour.value_or(options_));
  if (ordered.backgrounds != obeyed_.backgrounds) extractor_.takeBackground();
  obeyed_ = ordered;
}

bool ExtractingSource::poll(Observation& observation) {
  Frame frame;
  if (!source_->poll(frame)) return false;
  observation.camera = frame.camera;
  observation.sequence = frame.sequence;
  observation.exposure = frame.exposure;
  observation.arrival = frame.arrival;
  if (orders_ && orders_->take()) obey();
  extractor_.extract(frame.image, observation);
  if (on_frame_) on_frame_(frame, observation, extractor_);
  return true;
}

}  // namespace helical
