#include "engine/simulator/simulated_observer.h"

#include <algorithm>
#include <cmath>

#include "engine/geometry/rotation.h"
#include "engine/simulator/random_streams.h"

namespace helical {
namespace {

constexpr double kFalseRadius = 4.0;     // px
constexpr double kSmallestRadius = 1.5;  // px: below, opening removes it

}  // namespace

SimulatedObserver::SimulatedObserver(CameraId camera, const CameraModel& model,
                                     const RigidTransform& camera_from_world, const MarkerLayout& markers,
                                     const MarkerOptions& marker_options, const SimulationOptions& options,
                                     std::shared_ptr<World> world, std::shared_ptr<Clock> clock)
    : camera_(camera),
      model_(model),
      markers_(markers),
      centroid_sigma_px_(std::max(marker_options.centroid_sigma_px, options.noise.sigma_px)),
      noise_(options.noise),
      world_(std::move(world)),
      clock_(std::move(clock)),
      disturbances_(camera, options, camera_from_world,
                    randomStream(options.seed, RandomStream::kKnocks, camera)),
      exposures_(options, randomStream(options.seed, RandomStream::kExposures, camera)),
      random_(randomStream(options.seed, RandomStream::kObservations, camera)) {
  for (auto& offset : offsets_) offset = noise_.bias_px * Eigen::Vector2d(random_.normal(), random_.normal());
}

void SimulatedObserver::wait(TimeNs deadline) {
  clock_->sleepUntil(std::min(deadline, exposures_.arrival()));
}

bool SimulatedObserver::poll(Observation& observation) {
  const TimeNs now = clock_->now();
  exposures_.skipLost(now);
  if (now < exposures_.arrival()) return false;
  world_->advanceTo(now);
  observation.camera = camera_;
  observation.sequence = exposures_.sequence();
  observation.exposure = exposures_.exposure();
  observation.arrival = exposures_.arrival();
  observation.extraction = 0;
  observation.count = 0;
  observation.truncated = false;
  if (const auto sample = world_->at(observation.exposure))
    observe(*sample, toSeconds(observation.exposure), observation);
  exposures_.next();
  return true;
}

void SimulatedObserver::driftOffsets(double dt) {
  const double keep = std::exp(-dt / noise_.bias_time_s);
  const double kick = noise_.bias_px * std::sqrt(1.0 - keep * keep);
  for (auto& offset : offsets_)
    offset = keep * offset + kick * Eigen::Vector2d(random_.normal(), random_.normal());
}

void SimulatedObserver::observe(const WorldSample& sample, double time_s, Observation& observation) {
  driftOffsets(time_s - offsets_time_s_);
  offsets_time_s_ = time_s;
  const RigidTransform camera_from_world = world_->knocked(camera_, disturbances_.cameraFromWorld(time_s));
  const double board_edge = disturbances_.boardCover(time_s) * model_.width();

  std::array<Disc, kMaxMarkers> discs;
  int count = 0;
  for (int m = 0; m < markers_.count(); ++m) {
    const Eigen::Vector3d in_camera =
        camera_from_world * (sample.state.world_from_body * markers_.inBody(markerId(m)));
    const auto pixel = model_.project(in_camera);
    // The draws come first: a ball that leaves the image must not change the luck of the others.
    const Eigen::Vector2d white = noise_.sigma_px * Eigen::Vector2d(random_.normal(), random_.normal());
    const bool dropped = random_.uniform() < noise_.dropout + noise_.lost_markers;
    const bool thrown = random_.uniform() < noise_.outliers;
    const Eigen::Vector2d aside =
        kOutlierReachPx * Eigen::Vector2d(random_.uniform(-1.0, 1.0), random_.uniform(-1.0, 1.0));
    if (!pixel || dropped) continue;
    const double radius = model_.fx() * markers_.radius() / in_camera.z();
    Eigen::Vector2d seen = *pixel + white + offsets_[static_cast<std::size_t>(m)];
    if (thrown) seen += aside;
    if (radius < kSmallestRadius || seen.x() < board_edge || !model_.contains(seen, radius)) continue;
    discs[static_cast<std::size_t>(count++)] = {seen, radius};
  }
  addMerged(discs, count, observation);
  const bool false_marker = random_.uniform() < noise_.false_markers;
  const Eigen::Vector2d anywhere(random_.uniform(0.0, model_.width()), random_.uniform(0.0, model_.height()));
  if (false_marker && anywhere.x() >= board_edge)
    add(anywhere, kPi * kFalseRadius * kFalseRadius, observation);
}

void SimulatedObserver::addMerged(std::array<Disc, kMaxMarkers>& discs, int count, Observation& observation) {
  std::array<bool, kMaxMarkers> done{};
  for (int a = 0; a < count; ++a) {
    if (done[static_cast<std::size_t>(a)]) continue;
    const Disc& disc = discs[static_cast<std::size_t>(a)];
    double area = kPi * disc.radius * disc.radius;
    Eigen::Vector2d moment = area * disc.pixel;
    for (int b = a + 1; b < count; ++b) {
      const Disc& other = discs[static_cast<std::size_t>(b)];
      if (done[static_cast<std::size_t>(b)] ||
          (other.pixel - disc.pixel).norm() > disc.radius + other.radius + 1.0)
        continue;
      done[static_cast<std::size_t>(b)] = true;
      area += kPi * other.radius * other.radius;
      moment += kPi * other.radius * other.radius * other.pixel;
    }
    add(moment / area, area, observation);
  }
}

void SimulatedObserver::add(Eigen::Vector2d pixel, double area, Observation& observation) {
  if (observation.count == kMaxCentroids) {
    observation.truncated = true;
    return;
  }
  Centroid& centroid = observation.centroids[static_cast<std::size_t>(observation.count++)];
  centroid.pixel = pixel;
  centroid.area_px = area;
  centroid.radius_px = std::sqrt(area / kPi);
  centroid.covariance = centroid_sigma_px_ * centroid_sigma_px_ * Eigen::Matrix2d::Identity();
}

}  // namespace helical
