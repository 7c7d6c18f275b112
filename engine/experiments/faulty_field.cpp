#include "engine/experiments/faulty_field.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/flight/fence.h"

namespace helical {
namespace {

constexpr TimeNs kStep = kNanosecondsPerMillisecond;
constexpr double kLowFenceM = 1.6;   // the simulated field ends 2.5 m up: the hard fence lies well below
constexpr double kKnockM = 0.05;     // shift, for a turn of 0.1 rad
constexpr double kTooLittleGb = 0.1;

RigConfig faultyRig(const RigConfig& rig, std::uint64_t seed, const std::vector<Fault>& faults) {
  RigConfig faulty = rig;
  faulty.simulation.seed = seed;
  faulty.simulation.images = false;
  faulty.safety.fence_height = std::min(faulty.safety.fence_height, kLowFenceM);
  for (const Fault& fault : faults)
    if (fault.kind == FaultKind::kParameters) faulty.simulation.vary = fault.amount;
  return faulty;
}

}  // namespace

FaultyField::FaultyField(const RigConfig& rig, std::uint64_t seed, std::vector<Fault> faults)
    : rig_(faultyRig(rig, seed, faults)),
      faults_(std::move(faults)),
      clock_(std::make_shared<ManualClock>()),
      hardware_(openRig(rig_, clock_)),
      transmitter_([this] {
        auto faulty = std::make_unique<FaultyTransmitter>(std::move(hardware_.transmitter), faults_);
        FaultyTransmitter* plain = faulty.get();
        hardware_.transmitter = std::move(faulty);
        return plain;
      }()),
      output_(*hardware_.transmitter) {
  for (std::size_t i = 0; i < hardware_.sources.size(); ++i) {
    const CameraModel& model = rig_.cameras[i].model;
    hardware_.sources[i] = std::make_unique<FaultySource>(std::move(hardware_.sources[i]), faults_, clock_, model.width(),
                                                          model.height(), seed);
  }
}

void FaultyField::advance() {
  clock_->set(clock_->now() + kStep);
  const double time_s = toSeconds(clock_->now());
  for (const Fault& fault : faults_) {
    if (fault.from_s <= before_s_ || fault.from_s > time_s) continue;
    hardware_.world->advanceTo(clock_->now());
    if (fault.kind == FaultKind::kGust)
      hardware_.world->gust(fault.amount * Eigen::Vector3d(std::cos(fault.direction), std::sin(fault.direction), 0.0),
                            fault.to_s - fault.from_s);
    if (fault.kind == FaultKind::kCameraKnocked)
      hardware_.world->knock(fault.camera, fault.amount, kKnockM * fault.amount / 0.1);
  }
  before_s_ = time_s;
}

DeviceStatus FaultyField::devices() {
  DeviceStatus devices;
  devices.transmitter = output_.transmitterStatus();
  devices.record.recording = true;
  for (const Fault& fault : faults_)
    if (fault.kind == FaultKind::kDiskFull && actsNow(fault, toSeconds(now()))) {
      devices.record.cut_off = true;
      devices.record.disk_free_gb = kTooLittleGb;
    }
  return devices;
}

bool FaultyField::powered() const {
  return transmitter_->delivered().upper_rotor > 0.0 || transmitter_->delivered().lower_rotor > 0.0;
}

double FaultyField::beyondHardFence(const HelicopterState& truth) const {
  Eigen::Vector3d place = truth.world_from_body.translation;
  place.z() -= rig_.helicopter.standing_height;
  return beyondFence(rig_.safety, place) - rig_.safety.hard_fence_margin;
}

TimeNs FaultyField::starvation() const {
  for (const Fault& fault : faults_)
    if (fault.kind == FaultKind::kProcessorStarved && actsNow(fault, toSeconds(now()))) return fromSeconds(fault.amount);
  return 0;
}

}  // namespace helical
