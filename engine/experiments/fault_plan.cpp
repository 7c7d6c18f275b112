#include "engine/experiments/fault_plan.h"

#include <algorithm>
#include <limits>

#include "engine/base/random.h"

namespace helical {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kForEver = 1e9;
constexpr std::uint64_t kStream = 0xFA17;
constexpr int kMostFaults = 4;
constexpr double kEarliestS = 0.5, kLatestS = 16.0;

/// How long it lasts, and how much of it there is.
struct Extent {
  double shortest_s, longest_s;
  double least, most;
};

Extent extentOf(FaultKind kind) {
  switch (kind) {
    case FaultKind::kCamerasHidden:
      return {0.1, 3.0, 0.0, 0.0};
    case FaultKind::kCameraHidden:
      return {0.5, 15.0, 0.0, 0.0};
    case FaultKind::kCameraLost:
      return {0.3, 15.0, 0.0, 0.0};
    case FaultKind::kCameraKnocked:
      return {kForEver, kForEver, 0.05, 0.2};
    case FaultKind::kCameraLate:
      return {0.5, 8.0, 0.02, 0.12};
    case FaultKind::kCamerasSwapped:
      return {0.5, kForEver, 0.0, 0.0};
    case FaultKind::kMarkersMissing:
      return {1.0, 10.0, 0.1, 0.6};
    case FaultKind::kMarkersFalse:
      return {1.0, 10.0, 1.0, 4.0};
    case FaultKind::kMarkersSwapped:
      return {1.0, 10.0, 0.1, 0.7};
    case FaultKind::kClockJump:
      return {kForEver, kForEver, 0.02, 0.08};
    case FaultKind::kTransmitterUnplugged:
      return {0.3, 5.0, 0.0, 0.0};
    case FaultKind::kTransmitterStalled:
      return {0.02, 0.5, 0.0, 0.0};
    case FaultKind::kTransmitterSlow:
      return {1.0, 10.0, 0.005, 0.03};
    case FaultKind::kGust:
      return {0.5, 2.0, 0.5, 2.5};
    case FaultKind::kProcessorStarved:
      return {0.2, 2.0, 0.02, 0.15};
    case FaultKind::kDiskFull:
      return {kForEver, kForEver, 0.0, 0.0};
    case FaultKind::kParameters:
      return {kForEver, kForEver, 0.3, 0.3};
  }
  return {0.0, 0.0, 0.0, 0.0};
}

}  // namespace

const char* toString(FaultKind kind) {
  switch (kind) {
    case FaultKind::kCamerasHidden:
      return "cameras-hidden";
    case FaultKind::kCameraHidden:
      return "camera-hidden";
    case FaultKind::kCameraLost:
      return "camera-lost";
    case FaultKind::kCameraKnocked:
      return "camera-knocked";
    case FaultKind::kCameraLate:
      return "camera-late";
    case FaultKind::kCamerasSwapped:
      return "cameras-swapped";
    case FaultKind::kMarkersMissing:
      return "markers-missing";
    case FaultKind::kMarkersFalse:
      return "markers-false";
    case FaultKind::kMarkersSwapped:
      return "markers-swapped";
    case FaultKind::kClockJump:
      return "clock-jump";
    case FaultKind::kTransmitterUnplugged:
      return "transmitter-unplugged";
    case FaultKind::kTransmitterStalled:
      return "transmitter-stalled";
    case FaultKind::kTransmitterSlow:
      return "transmitter-slow";
    case FaultKind::kGust:
      return "gust";
    case FaultKind::kProcessorStarved:
      return "processor-starved";
    case FaultKind::kDiskFull:
      return "disk-full";
    case FaultKind::kParameters:
      return "parameters";
  }
  return "";
}

double detectionLimit(FaultKind kind) {
  switch (kind) {
    case FaultKind::kCamerasHidden:
      return 0.05;
    case FaultKind::kCameraLost:
    case FaultKind::kTransmitterUnplugged:
    case FaultKind::kTransmitterStalled:
      return 0.1;
    case FaultKind::kCamerasSwapped:
    case FaultKind::kProcessorStarved:
      return 0.5;
    case FaultKind::kCameraKnocked:
    case FaultKind::kCameraLate:
    case FaultKind::kClockJump:
    case FaultKind::kDiskFull:
      return 1.0;
    default:
      return kNaN;
  }
}

std::vector<Fault> drawFaults(std::uint64_t seed, int cameras) {
  Random random = Random(seed).fork(kStream);
  const auto below = [&](int count) { return static_cast<int>(random.uniform() * count); };
  std::vector<Fault> faults;
  const int count = 1 + below(kMostFaults);
  while (static_cast<int>(faults.size()) < count) {
    Fault fault;
    fault.kind = static_cast<FaultKind>(below(kFaultKindCount));
    const Extent extent = extentOf(fault.kind);
    fault.from_s = random.uniform(kEarliestS, kLatestS);
    fault.to_s = fault.from_s + random.uniform(extent.shortest_s, std::min(extent.longest_s, 20.0));
    if (extent.longest_s == kForEver) fault.to_s = extent.shortest_s == kForEver ? kForEver : fault.to_s;
    fault.camera = cameraId(below(cameras));
    fault.other = cameraId((fault.camera.index() + 1 + below(cameras - 1)) % cameras);
    fault.amount = random.uniform(extent.least, extent.most);
    fault.direction = random.uniform(0.0, 6.283185307179586);
    if (fault.kind == FaultKind::kParameters) fault.from_s = 0.0;
    // Stamps jump either way.
    if (fault.kind == FaultKind::kClockJump && random.uniform() < 0.5) fault.amount = -fault.amount;
    const bool twice = std::any_of(faults.begin(), faults.end(), [&](const Fault& f) { return f.kind == fault.kind; });
    if (!twice) faults.push_back(fault);
  }
  return faults;
}

}  // namespace helical
