#include "engine/simulator/virtual_rig.h"

#include <algorithm>
#include <cstdio>
#include <optional>
#include <utility>

#include "engine/base/log.h"
#include "engine/base/monotonic.h"
#include "engine/simulator/random_streams.h"
#include "engine/simulator/simulated_view.h"
#include "engine/simulator/true_rig.h"

namespace helical {
namespace {

constexpr TimeNs kWatchPeriod = 5 * kNanosecondsPerMillisecond;
constexpr TimeNs kTransmitterOff = 2 * kNanosecondsPerSecond;
constexpr TimeNs kReceiverFailsafe = kNanosecondsPerSecond / 2;

}  // namespace

/// What one camera sees of whichever field there is.
class VirtualRig::Lens {
 public:
  Lens(VirtualRig& rig, std::size_t index)
      : rig_(rig),
        view_(cameraId(static_cast<int>(index)),
              trueModel(cameraId(static_cast<int>(index)), rig.options_.cameras[index].model,
                        rig.options_.simulation),
              rig.options_.cameras[index].camera_from_world,
              trueMarkers(rig.options_.markers, rig.options_.simulation), rig.options_.simulation) {}

  ImageView picture(TimeNs mid_exposure) {
    const Field field = rig_.field();
    // A field that was renewed meanwhile has no past.
    const TimeNs exposure = std::max<TimeNs>(0, mid_exposure - field.began);
    field.world->advanceTo(exposure);
    return view_.render(*field.world, exposure);
  }

 private:
  VirtualRig& rig_;
  SimulatedView view_;
};

VirtualRig::VirtualRig(const VirtualRigOptions& options, std::vector<ScheduledFault> faults)
    : options_(options),
      faults_(std::move(faults)),
      keeper_(options_.cameras.size(), options_.background_frames),
      done_(faults_.size()) {
  renewField(monotonicNow());
  for (std::size_t i = 0; i < options_.cameras.size(); ++i) {
    lenses_.push_back(std::make_unique<Lens>(*this, i));
    const VirtualCameraPlace& place = options_.cameras[i];
    gige::VirtualCamera::Options camera;
    char serial[16];
    std::snprintf(serial, sizeof serial, "HV-%08X", parseIp(place.address));
    camera.identity = {parseIp(place.address), serial, place.name, place.model.width(), place.model.height()};
    camera.readout_s = options_.simulation.readout_delay_s;
    camera.seed = randomStream(options_.simulation.seed, RandomStream::kExposures, cameraId(static_cast<int>(i))).bits();
    cameras_.push_back(std::make_unique<gige::VirtualCamera>(
        camera, [lens = lenses_.back().get()](TimeNs mid_exposure) { return lens->picture(mid_exposure); }));
  }
  receiver_ = std::make_unique<LoopbackReceiver>(
      options_.transmitter, [this](const StickDemand& demand, TimeNs when) { onSticks(demand, when); });
  watcher_ = std::jthread([this](const std::stop_token& stop) { watch(stop); });
}

VirtualRig::~VirtualRig() {
  watcher_ = {};
  receiver_.reset();
  cameras_.clear();
}

VirtualRig::Field VirtualRig::field() const {
  const std::lock_guard lock(mutex_);
  return field_;
}

Verdict VirtualRig::verdict() const {
  const std::lock_guard lock(mutex_);
  return flown_ ? flown_->verdict() : Verdict{};
}

double VirtualRig::flightTime() const {
  const std::lock_guard lock(mutex_);
  return switched_on_ < 0 ? -1.0 : toSeconds(monotonicNow() - switched_on_);
}

/// Locked, but in the constructor.
void VirtualRig::renewField(TimeNs now) {
  field_ = {std::make_shared<World>(options_.simulation, options_.helicopter), now};
  field_.world->holdEmpty();
  held_empty_ = true;
  radio_ = std::make_unique<SimulatedTransmitter>(options_.simulation, field_.world);
}

/// Locked.
bool VirtualRig::transmitterOn(TimeNs now) const {
  return last_packet_ >= 0 && now - last_packet_ <= kTransmitterOff;
}

void VirtualRig::onSticks(const StickDemand& demand, TimeNs when) {
  const std::lock_guard lock(mutex_);
  if (!transmitterOn(when)) {
    renewField(when);
    flown_ = field_.world;
    switched_on_ = when;
    log(LogLevel::kInfo, "a transmitter is switched on: the field is empty, then the helicopter is put on its pad");
  }
  last_packet_ = when;
  rotors_stopped_ = false;
  radio_->send(demand, when - field_.began);
}

void VirtualRig::watch(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    const TimeNs now = monotonicNow();
    applyFaults(now);
    {
      const std::lock_guard lock(mutex_);
      keepField(now);
      if (!rotors_stopped_ && now - last_packet_ > kReceiverFailsafe) {
        rotors_stopped_ = true;
        radio_->send({}, now - field_.began);
        log(LogLevel::kWarning, "the helicopter hears no transmitter: rotors off");
      }
    }
    const Field current = field();
    current.world->advanceTo(now - current.began);
    sleepUntilMonotonic(now + kWatchPeriod);
  }
}

/// Locked.
void VirtualRig::keepField(TimeNs now) {
  std::vector<FieldKeeper::Camera> cameras;
  for (const auto& camera : cameras_) cameras.push_back({camera->streaming(), camera->counts().frames});
  const auto switched_on = transmitterOn(now) ? std::optional(switched_on_) : std::nullopt;
  const bool in = keeper_.helicopterIn(now, switched_on, cameras);
  if (in == !held_empty_) return;
  if (!in) return renewField(now);
  field_.world->releaseEmpty();
  held_empty_ = false;
}

void VirtualRig::applyFaults(TimeNs now) {
  TimeNs began = 0;
  {
    const std::lock_guard lock(mutex_);
    began = switched_on_ >= 0 ? switched_on_ : field_.began;
  }
  const double time_s = toSeconds(now - began);
  std::vector<gige::CameraFaults> faults(cameras_.size());
  for (std::size_t i = 0; i < faults_.size(); ++i) {
    const ScheduledFault& fault = faults_[i];
    const bool now_so = time_s >= fault.from_s && time_s < fault.to_s;
    gige::CameraFaults& camera = faults[fault.camera];
    switch (fault.kind) {
      case ScheduledFault::Kind::kLoss:
        if (now_so) camera.loss = fault.value;
        break;
      case ScheduledFault::Kind::kJitter:
        if (now_so) camera.jitter_s = fault.value;
        break;
      case ScheduledFault::Kind::kMute:
        camera.mute = camera.mute || now_so;
        break;
      case ScheduledFault::Kind::kTaken:
        camera.taken = camera.taken || now_so;
        break;
      case ScheduledFault::Kind::kReboot:
        if (now_so && !done_[i]) cameras_[fault.camera]->reboot(fault.to_s - time_s);
        done_[i] = now_so;
        break;
      case ScheduledFault::Kind::kClock:
        if (now_so && !done_[i]) cameras_[fault.camera]->setClock(fault.value, fault.drift);
        done_[i] = now_so;
        break;
    }
  }
  for (std::size_t i = 0; i < cameras_.size(); ++i) cameras_[i]->setFaults(faults[i]);
}

}  // namespace helical
