#pragma once

#include <memory>

#include "engine/base/random.h"
#include "engine/geometry/camera_model.h"
#include "engine/markers/observation.h"
#include "engine/simulator/simulation_options.h"

namespace helical {

/// Observations of rendered images, made worse: centroids are lost (`noise.lost_markers`) and thrown aside
/// (`noise.outliers`), as SimulatedObserver does without images. One thread.
class DisturbedSource final : public ObservationSource {
 public:
  DisturbedSource(std::unique_ptr<ObservationSource> source, const CameraModel& model,
                  const SimulationOptions& options);

  CameraId camera() const override { return source_->camera(); }
  bool poll(Observation& observation) override;
  void wait(TimeNs deadline) override { source_->wait(deadline); }

 private:
  std::unique_ptr<ObservationSource> source_;
  CameraModel model_;
  ObservationNoise noise_;
  Random random_;
};

}  // namespace helical
