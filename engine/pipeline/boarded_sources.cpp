#include "engine/pipeline/boarded_sources.h"

#include <algorithm>
#include <utility>

namespace helical {

BoardedCamera::BoardedCamera(std::unique_ptr<CameraSource> source, std::shared_ptr<WhiteBoardsChannel> boards)
    : source_(std::move(source)), boards_(std::move(boards)) {}

bool BoardedCamera::poll(Frame& frame) {
  if (!source_->poll(frame)) return false;
  boards_->take();
  const WhiteBoards& boards = boards_->front();
  if (boards.count == 0) return true;
  ImageView& image = frame.image;
  // The source's own pixels may be a device's, or the ground for its next frame.
  pixels_.assign(image.data, image.data + static_cast<std::ptrdiff_t>(image.stride) * image.height);
  for (int i = 0; i < boards.count; ++i)
    paintBoard(boards.boards[static_cast<std::size_t>(i)], image, pixels_.data());
  image.data = pixels_.data();
  return true;
}

BoardedObserver::BoardedObserver(std::unique_ptr<ObservationSource> source,
                                 std::shared_ptr<WhiteBoardsChannel> boards)
    : source_(std::move(source)), boards_(std::move(boards)) {}

bool BoardedObserver::poll(Observation& observation) {
  if (!source_->poll(observation)) return false;
  boards_->take();
  const WhiteBoards& boards = boards_->front();
  if (boards.count == 0) return true;
  const auto begin = observation.centroids.begin();
  const auto seen = std::remove_if(begin, begin + observation.count,
                                   [&](const Centroid& centroid) { return boards.covers(centroid.pixel); });
  observation.count = static_cast<int>(seen - begin);
  return true;
}

}  // namespace helical
