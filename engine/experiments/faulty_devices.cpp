#include "engine/experiments/faulty_devices.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace helical {
namespace {

constexpr double kBesideAnother = 15.0;  // px
constexpr double kFalseRadius = 4.0;     // px

}  // namespace

bool actsNow(const Fault& fault, double time_s) {
  return time_s >= fault.from_s && time_s < fault.to_s;
}

FaultySource::FaultySource(std::unique_ptr<ObservationSource> source, std::vector<Fault> faults,
                           std::shared_ptr<Clock> clock, int width, int height, std::uint64_t seed)
    : source_(std::move(source)),
      faults_(std::move(faults)),
      clock_(std::move(clock)),
      width_(width),
      height_(height),
      random_(Random(seed).fork(0xCA3E00U + static_cast<std::uint64_t>(source_->camera().index()))) {}

void FaultySource::addFalse(double count, Observation& observation) {
  const int wanted = static_cast<int>(random_.uniform() * (count + 1.0));
  for (int i = 0; i < wanted && observation.count < kMaxCentroids; ++i) {
    Centroid& centroid = observation.centroids[static_cast<std::size_t>(observation.count++)];
    centroid = {};
    centroid.pixel = {random_.uniform(0.0, width_), random_.uniform(0.0, height_)};
    centroid.radius_px = kFalseRadius;
    centroid.area_px = 3.14159265 * kFalseRadius * kFalseRadius;
    centroid.covariance *= 0.01;
  }
}

void FaultySource::suffer(const Fault& fault, Observation& observation) {
  auto& centroids = observation.centroids;
  const auto end = centroids.begin() + observation.count;
  switch (fault.kind) {
    case FaultKind::kCamerasHidden:
    case FaultKind::kCameraHidden:
      observation.count = 0;
      break;
    case FaultKind::kMarkersMissing:
      observation.count = static_cast<int>(
          std::remove_if(centroids.begin(), end, [&](const Centroid&) { return random_.uniform() < fault.amount; }) -
          centroids.begin());
      break;
    case FaultKind::kMarkersFalse:
      addFalse(fault.amount, observation);
      break;
    case FaultKind::kMarkersSwapped:
      if (observation.count > 1 && random_.uniform() < fault.amount) {
        const auto any = [&] { return static_cast<std::size_t>(random_.uniform() * observation.count); };
        const Eigen::Vector2d aside(random_.uniform(-1.0, 1.0), random_.uniform(-1.0, 1.0));
        centroids[any()].pixel = centroids[any()].pixel + kBesideAnother * aside;
      }
      break;
    case FaultKind::kClockJump:
      observation.exposure += fromSeconds(fault.amount);
      break;
    case FaultKind::kCamerasSwapped:
      observation.camera = observation.camera == fault.camera ? fault.other : fault.camera;
      break;
    default:
      break;
  }
}

bool FaultySource::suffer(Observation& observation, TimeNs& late) {
  const double time_s = toSeconds(observation.arrival);
  const CameraId camera = source_->camera();
  for (const Fault& fault : faults_) {
    const bool of_all = fault.kind == FaultKind::kCamerasHidden;
    const bool of_both = fault.kind == FaultKind::kCamerasSwapped && fault.other == camera;
    if (!actsNow(fault, time_s) || !(of_all || of_both || fault.camera == camera)) continue;
    if (fault.kind == FaultKind::kCameraLost) return false;
    if (fault.kind == FaultKind::kCameraLate) late += fromSeconds(fault.amount);
    suffer(fault, observation);
  }
  return true;
}

bool FaultySource::poll(Observation& observation) {
  // What was on its way is lost with its camera.
  const auto is_lost = [this](const Fault& fault) {
    return fault.kind == FaultKind::kCameraLost && fault.camera == source_->camera() &&
           actsNow(fault, toSeconds(clock_->now()));
  };
  if (std::any_of(faults_.begin(), faults_.end(), is_lost)) waiting_.clear();
  Observation newest;
  while (source_->poll(newest)) {
    TimeNs late = 0;
    if (!suffer(newest, late)) continue;
    const TimeNs due = std::max(waiting_.empty() ? 0 : waiting_.back().due, newest.arrival + late);
    newest.arrival = due;
    waiting_.push_back({due, newest});
  }
  if (waiting_.empty() || waiting_.front().due > clock_->now()) return false;
  observation = waiting_.front().observation;
  waiting_.pop_front();
  return true;
}

FaultyTransmitter::FaultyTransmitter(std::unique_ptr<Transmitter> transmitter, std::vector<Fault> faults)
    : transmitter_(std::move(transmitter)), faults_(std::move(faults)) {}

void FaultyTransmitter::send(const StickDemand& demand, TimeNs now) {
  status_ = {};
  TimeNs late = 0;
  for (const Fault& fault : faults_) {
    if (!actsNow(fault, toSeconds(now))) continue;
    if (fault.kind == FaultKind::kTransmitterUnplugged) {
      status_.present = status_.self_test_passed = false;
      status_.trouble = TransmitterTrouble::kAbsent;
    }
    if (fault.kind == FaultKind::kTransmitterStalled) status_.trouble = TransmitterTrouble::kTimedOut;
    if (fault.kind == FaultKind::kTransmitterSlow) late = fromSeconds(fault.amount);
  }
  status_.fault = status_.trouble != TransmitterTrouble::kNone;
  if (status_.present && status_.fault) return;
  delivered_ = status_.present ? demand : StickDemand{};
  transmitter_->send(delivered_, now + late);
}

}  // namespace helical
