#include "engine/markers/extracting_source.h"

#include <utility>

namespace helical {

ExtractingSource::ExtractingSource(std::unique_ptr<CameraSource> source, const MarkerOptions& options,
                                   FrameTap on_frame)
    : source_(std::move(source)), extractor_(options), on_frame_(std::move(on_frame)) {}

bool ExtractingSource::poll(Observation& observation) {
  Frame frame;
  if (!source_->poll(frame)) return false;
  observation.camera = frame.camera;
  observation.sequence = frame.sequence;
  observation.exposure = frame.exposure;
  observation.arrival = frame.arrival;
  extractor_.extract(frame.image, observation);
  if (on_frame_) on_frame_(frame, observation);
  return true;
}

}  // namespace helical
