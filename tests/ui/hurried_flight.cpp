#include "tests/ui/hurried_flight.h"

#include <cstddef>

namespace helical {

HurriedFlight::HurriedFlight(const RigConfig& rig, const FlightPlan& plan, int ticks_a_poll)
    : rig_(rig), plan_(plan), ticks_a_poll_(ticks_a_poll), flight_(rig, plan), announcer_(rig) {
  belief_.total = belief_.count = CalibrationView::kMaxParticles;
  for (std::size_t i = 0; i < static_cast<std::size_t>(belief_.count); ++i) {
    belief_.particles[i].centre_in_world = {0.01F * static_cast<float>(i), 1.0F, 1.0F};
    belief_.particles[i].weight = 0.5F;
  }
  for (const CameraConfig& camera : rig_.cameras) {
    CameraPicture picture;
    picture.width = camera.model.width();
    picture.height = camera.model.height();
    picture.bgr.resize(static_cast<std::size_t>(3 * picture.width * picture.height));
    std::uint32_t noise = 1;
    for (std::uint8_t& value : picture.bgr)
      value = static_cast<std::uint8_t>((noise = noise * 1664525U + 1013904223U) >> 24);
    pictures_.push_back(std::move(picture));
  }
}

bool HurriedFlight::poll() {
  for (int i = 0; i < ticks_a_poll_; ++i) {
    snapshot_ = flight_.tick(commands_);
    commands_ = {};
    commands_.arm = commands_.take_off =
        snapshot_.phase == FlightPhase::kIdle && snapshot_.failing_checks == 0;
    announcer_.announce(snapshot_, false, [this](const EngineEvent& event) { events_.push_back(event); });
    ticks_.push_back(snapshot_);
  }
  return true;
}

bool HurriedFlight::pollPicture(CameraId camera) {
  CameraPicture& picture = pictures_[static_cast<std::size_t>(camera.index())];
  ++picture.sequence;
  picture.exposure = snapshot_.time;
  return true;
}

const CameraPicture& HurriedFlight::picture(CameraId camera) const {
  return pictures_[static_cast<std::size_t>(camera.index())];
}

bool HurriedFlight::nextTick(EngineSnapshot& tick) {
  if (ticks_.empty()) return false;
  tick = ticks_.front();
  ticks_.pop_front();
  return true;
}

bool HurriedFlight::nextEvent(EngineEvent& event) {
  if (events_.empty()) return false;
  event = events_.front();
  events_.pop_front();
  return true;
}

}  // namespace helical
