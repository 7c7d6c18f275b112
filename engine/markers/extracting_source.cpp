#include "engine/markers/extracting_source.h"

#include <utility>

#include "engine/base/clock.h"
#include "engine/markers/sphere_image.h"

namespace helical {

ExtractingSource::ExtractingSource(std::unique_ptr<CameraSource> source, const MarkerOptions& options,
                                   FrameTap on_frame, std::shared_ptr<ExtractorOrders> orders,
                                   const std::optional<CameraModel>& lens)
    : source_(std::move(source)),
      extractor_(options),
      on_frame_(std::move(on_frame)),
      orders_(std::move(orders)),
      lens_(lens) {
  if (const auto format = source_->format()) extractor_.prepare(*format);
}

bool ExtractingSource::poll(Observation& observation) {
  Frame frame;
  if (!source_->poll(frame)) return false;
  observation.camera = frame.camera;
  observation.sequence = frame.sequence;
  observation.exposure = frame.exposure;
  observation.arrival = frame.arrival;
  if (orders_) orders_->carryOut(extractor_);
  const TimeNs start = threadCpuTime();
  extractor_.extract(frame.image, observation);
  observation.extraction = threadCpuTime() - start;
  if (lens_) moveToBallCentres(*lens_, observation);
  if (on_frame_) on_frame_(frame, observation, extractor_);
  return true;
}

}  // namespace helical
