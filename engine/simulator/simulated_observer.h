#pragma once

#include <array>
#include <memory>

#include "engine/base/clock.h"
#include "engine/geometry/camera_model.h"
#include "engine/helicopter/marker_layout.h"
#include "engine/markers/marker_options.h"
#include "engine/markers/observation.h"
#include "engine/simulator/disturbances.h"
#include "engine/simulator/exposure_clock.h"
#include "engine/simulator/world.h"

namespace helical {

/// A camera of the simulated field without images: what the extractor would have made of them, as numbers,
/// with noise, slowly changing offsets, drop-outs, false and merged markers as in SimulationOptions::noise.
/// One thread.
class SimulatedObserver final : public ObservationSource {
 public:
  SimulatedObserver(CameraId camera, const CameraModel& model, const RigidTransform& camera_from_world,
                    const MarkerLayout& markers, const MarkerOptions& marker_options,
                    const SimulationOptions& options, std::shared_ptr<World> world,
                    std::shared_ptr<Clock> clock);

  CameraId camera() const override { return camera_; }
  bool poll(Observation& observation) override;
  void wait(TimeNs deadline) override;

 private:
  struct Disc {
    Eigen::Vector2d pixel;
    double radius;
  };
  void observe(const WorldSample& sample, double time_s, Observation& observation);
  void addMerged(std::array<Disc, kMaxMarkers>& discs, int count, Observation& observation);
  void add(Eigen::Vector2d pixel, double area, Observation& observation);
  void driftOffsets(double dt);

  CameraId camera_;
  CameraModel model_;
  MarkerLayout markers_;
  double centroid_sigma_px_;
  ObservationNoise noise_;
  std::shared_ptr<World> world_;
  std::shared_ptr<Clock> clock_;
  CameraDisturbances disturbances_;
  ExposureClock exposures_;
  Random random_;
  std::array<Eigen::Vector2d, kMaxMarkers> offsets_;
  double offsets_time_s_ = 0.0;
};

}  // namespace helical
