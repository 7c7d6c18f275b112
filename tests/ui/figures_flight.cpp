#include "tests/ui/figures_flight.h"

#include <algorithm>
#include <cmath>

#include "engine/base/random.h"

namespace helical {
namespace {

constexpr int kRate = 60;
constexpr double kTakeOff = 2.0;
constexpr double kCovered = 13.0;
constexpr double kLanding = 22.0;
constexpr double kHeight = 0.6;

double plannedHeight(double time) {
  if (time < kTakeOff) return 0.0;
  if (time < kLanding) return std::min(kHeight, 0.2 * (time - kTakeOff));
  return std::max(0.0, kHeight - 0.25 * (time - kLanding));
}

std::uint16_t selectedIn(int camera, double time, Random& random) {
  if (camera == 1 && time >= kCovered) return random.uniform() < 0.02 ? 1 : 0;
  if (camera == 2 && time < 4.0) return 0;
  std::uint16_t markers = 0;
  for (int m = 0; m < 4; ++m) {
    if (random.uniform() > 0.01) markers = static_cast<std::uint16_t>(markers | 1 << m);
  }
  return markers;
}

/// A flight until `end`, whose camera 3 is found with the time constant `settling`.
FlightTrace flight(const char* name, double end, double settling, std::uint64_t seed) {
  FlightTrace trace;
  trace.name = name;
  trace.camera_count = 3;
  trace.marker_count = 4;
  trace.covered_camera = 1;
  trace.covered_from_s = kCovered;
  Random random(seed);
  Eigen::Vector3d sway = Eigen::Vector3d::Zero();
  for (int i = 0; i <= end * kRate; ++i) {
    TraceSample sample;
    sample.time_s = static_cast<double>(i) / kRate;
    const double flying = plannedHeight(sample.time_s) > 0.0 ? 1.0 : 0.0;
    for (int k = 0; k < 3; ++k) sway(k) += flying * (-0.02 * sway(k) + 0.004 * random.normal());
    sample.reference = Eigen::Vector3d(0.0, 0.0, plannedHeight(sample.time_s));
    sample.position = sample.reference + sway;
    sample.position.z() = std::max(0.0, sample.position.z());
    sample.yaw = 0.8 * sway.x() + 0.005 * random.normal();
    for (int c = 0; c < trace.camera_count; ++c)
      sample.selected[static_cast<std::size_t>(c)] = selectedIn(c, sample.time_s, random);
    const double left = std::exp(-std::max(0.0, sample.time_s - 3.0) / settling);
    const auto noise = [&] { return Eigen::Vector3d(random.normal(), random.normal(), random.normal()); };
    sample.camera_position_error = left * Eigen::Vector3d(0.25, -0.3, 0.12) + 0.004 * noise();
    sample.camera_rotation_error = left * Eigen::Vector3d(0.2, 0.1, -0.15) + 0.004 * noise();
    trace.samples.push_back(sample);
  }
  return trace;
}

}  // namespace

FlightTrace landedFlight() {
  return flight("experiment B", 25.0, 1.2, 7);
}

FlightTrace crashedFlight() {
  FlightTrace trace = flight("experiment A", 16.5, 9.0, 8);
  trace.crashed = true;
  trace.crashed_at_s = 16.5;
  Random random(9);
  for (TraceSample& sample : trace.samples) {
    sample.camera_position_error += 0.1 * Eigen::Vector3d(random.normal(), random.normal(), random.normal());
    const double adrift = std::max(0.0, sample.time_s - kCovered);
    sample.position += adrift * adrift * Eigen::Vector3d(-0.04, 0.06, -0.05);
    sample.position.z() = std::max(0.0, sample.position.z());
    sample.yaw += 0.15 * adrift;
  }
  return trace;
}

}  // namespace helical
