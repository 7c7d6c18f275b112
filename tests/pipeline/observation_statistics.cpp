#include "tests/pipeline/observation_statistics.h"

#include <algorithm>
#include <cmath>

#include "engine/geometry/rotation.h"

namespace helical {
namespace {

constexpr double kNear = 6.0;   // px: a centroid nearer than this to a ball's true centre is that ball
constexpr double kWhole = 0.8;  // share of the disc's area

}  // namespace

void ObservationStatistics::add(const Observation& observation, const WorldSample& truth,
                                const CameraModel& model, const RigidTransform& camera_from_world,
                                const MarkerLayout& markers) {
  ++frames_;
  int matched = 0;
  for (int m = 0; m < markers.count(); ++m) {
    auto& last = last_error_[static_cast<std::size_t>(m)];
    const Eigen::Vector3d in_camera =
        camera_from_world * (truth.state.world_from_body * markers.inBody(markerId(m)));
    const auto pixel = model.project(in_camera);
    const double radius = model.fx() * markers.radius() / in_camera.z();
    if (!pixel || !model.contains(*pixel, radius + 2.0)) {
      last.reset();
      continue;
    }
    ++expected_;
    const Centroid* nearest = nullptr;
    for (int c = 0; c < observation.count; ++c) {
      const Centroid& centroid = observation.centroids[static_cast<std::size_t>(c)];
      const double distance = (centroid.pixel - *pixel).norm();
      if (distance < kNear && (nearest == nullptr || distance < (nearest->pixel - *pixel).norm()))
        nearest = &centroid;
    }
    if (nearest == nullptr) {
      ++dropped_;
      last.reset();
      continue;
    }
    ++matched;
    if (nearest->area_px < kWhole * kPi * radius * radius) {
      ++hidden_;
      last.reset();
      continue;
    }
    const Eigen::Vector2d error = nearest->pixel - *pixel;
    squares_ += error.squaredNorm();
    ++whole_;
    if (last) {
      step_squares_ += (error - *last).squaredNorm();
      ++steps_;
    }
    last = error;
  }
  false_ += std::max(0, observation.count - matched);
}

double ObservationStatistics::rms() const {
  return std::sqrt(squares_ / (2.0 * std::max(1, whole_)));
}
double ObservationStatistics::white() const {
  return std::sqrt(step_squares_ / (4.0 * std::max(1, steps_)));
}
double ObservationStatistics::slow() const {
  return std::sqrt(std::max(0.0, rms() * rms() - white() * white()));
}
double ObservationStatistics::dropoutShare() const {
  return static_cast<double>(dropped_) / std::max(1, expected_);
}
double ObservationStatistics::partlyHiddenShare() const {
  return static_cast<double>(hidden_) / std::max(1, expected_);
}
double ObservationStatistics::falsePerFrame() const {
  return static_cast<double>(false_) / std::max(1, frames_);
}

}  // namespace helical
