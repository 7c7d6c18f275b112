#pragma once

#include <memory>
#include <vector>

#include "engine/base/latest_value.h"
#include "engine/cameras/camera_source.h"
#include "engine/markers/observation.h"
#include "engine/pipeline/white_board.h"

namespace helical {

/// The boards before one camera: written by whoever moves them, read by the camera's capture thread.
using WhiteBoardsChannel = LatestValue<WhiteBoards>;

/// A camera whose frames show the boards before it, whatever kind of camera it is. Without boards the frames
/// pass untouched.
class BoardedCamera final : public CameraSource {
 public:
  BoardedCamera(std::unique_ptr<CameraSource> source, std::shared_ptr<WhiteBoardsChannel> boards);

  CameraId camera() const override { return source_->camera(); }
  bool poll(Frame& frame) override;
  void wait(TimeNs deadline) override { source_->wait(deadline); }

 private:
  std::unique_ptr<CameraSource> source_;
  std::shared_ptr<WhiteBoardsChannel> boards_;
  std::vector<std::uint8_t> pixels_;  ///< of the newest frame with a board
};

/// The same for a source without images: centroids behind a board are left out.
class BoardedObserver final : public ObservationSource {
 public:
  BoardedObserver(std::unique_ptr<ObservationSource> source, std::shared_ptr<WhiteBoardsChannel> boards);

  CameraId camera() const override { return source_->camera(); }
  bool poll(Observation& observation) override;
  void wait(TimeNs deadline) override { source_->wait(deadline); }

 private:
  std::unique_ptr<ObservationSource> source_;
  std::shared_ptr<WhiteBoardsChannel> boards_;
};

}  // namespace helical
