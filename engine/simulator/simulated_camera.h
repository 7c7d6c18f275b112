#pragma once

#include <memory>

#include "engine/base/clock.h"
#include "engine/cameras/camera_source.h"
#include "engine/simulator/exposure_clock.h"
#include "engine/simulator/simulated_view.h"
#include "engine/simulator/world.h"

namespace helical {

/// A camera of the simulated field with images: free-running, un-synchronised, read out some milliseconds
/// after the exposure. One thread.
class SimulatedCamera final : public CameraSource {
 public:
  SimulatedCamera(CameraId camera, const CameraModel& model, const RigidTransform& camera_from_world,
                  const MarkerLayout& markers, int background_frames, const SimulationOptions& options,
                  std::shared_ptr<World> world, std::shared_ptr<Clock> clock);

  CameraId camera() const override { return camera_; }
  std::optional<PixelFormat> format() const override { return PixelFormat::kBgr8; }
  bool poll(Frame& frame) override;
  void wait(TimeNs deadline) override;

 private:
  void expose(TimeNs now);

  CameraId camera_;
  std::shared_ptr<World> world_;
  std::shared_ptr<Clock> clock_;
  ExposureClock exposures_;
  SimulatedView view_;
  ImageView image_;
  int background_frames_;  ///< still to come, before the helicopter may be put on the pad
  bool exposed_ = false;   ///< `image_` shows the next frame
};

}  // namespace helical
