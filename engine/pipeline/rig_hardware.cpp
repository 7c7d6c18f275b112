#include "engine/pipeline/rig_hardware.h"

#include <algorithm>
#include <utility>

#include "engine/base/error.h"
#include "engine/markers/ignoring_source.h"
#include "engine/pipeline/rig_devices.h"
#include "engine/simulator/disturbed_source.h"
#include "engine/simulator/random_streams.h"
#include "engine/simulator/simulated_camera.h"
#include "engine/simulator/simulated_observer.h"
#include "engine/simulator/true_rig.h"

namespace helical {
void RigHardware::addTruth(EngineSnapshot& snapshot, TimeNs now) const {
  if (!world) return;
  world->advanceTo(now);
  for (std::size_t i = 0; i < disturbances.size(); ++i) {
    if (!disturbances[i]) continue;
    CameraSnapshot& camera = snapshot.cameras[i];
    camera.has_truth = true;
    camera.true_camera_from_world =
        world->knocked(cameraId(static_cast<int>(i)), disturbances[i]->cameraFromWorld(toSeconds(now)));
  }
  const auto truth = world->at(now);
  if (!truth) return;
  snapshot.has_truth = true;
  snapshot.truth = truth->state;
  snapshot.verdict = world->verdict();
}

void RigHardware::addLinks(EngineSnapshot& snapshot) const {
  for (std::size_t i = 0; i < links.size(); ++i) {
    CameraSnapshot& camera = snapshot.cameras[i];
    const CameraLink& link = *links[static_cast<std::size_t>(snapshot.streams[i].index())];
    camera.link = link.state.load(std::memory_order_relaxed);
    camera.returns = link.returns.load(std::memory_order_relaxed);
    camera.resent_packets = link.resent.load(std::memory_order_relaxed);
    camera.transfer = link.first_packet_to_frame.load(std::memory_order_relaxed);
    camera.clock_sigma_s = link.clock_sigma_s.load(std::memory_order_relaxed);
    camera.light = {link.exposure_us.load(std::memory_order_relaxed),
                    link.gain.load(std::memory_order_relaxed),
                    link.gain_in_db.load(std::memory_order_relaxed)};
  }
}

RigidTransform trueCameraFromWorld(const RigConfig& rig, CameraId id) {
  const auto index = static_cast<std::size_t>(id.index());
  const auto& truths = rig.simulation.true_camera_from_world;
  if (index < truths.size() && truths[index]) return *truths[index];
  const CameraConfig& camera = rig.cameras[index];
  if (camera.camera_from_world) return *camera.camera_from_world;
  throw Error(ErrorKind::kInput, "simulated camera " + camera.label + " has no place in the world", rig.path,
              "give it a [camera.pose], or its true pose in [[simulation.camera]]");
}

namespace {

/// What every camera has, whatever it is.
CameraId addCamera(RigHardware& hardware, const CameraConfig& camera) {
  const CameraId id = cameraId(static_cast<int>(hardware.sources.size()));
  hardware.tampering.push_back(std::make_shared<TamperingChannel>());
  hardware.orders.push_back(std::make_shared<ExtractorOrders>());
  hardware.orders.back()->ignore(camera.ignored_areas);
  hardware.links.push_back(std::make_shared<CameraLink>());
  hardware.disturbances.emplace_back();
  return id;
}

std::unique_ptr<ObservationSource> extracted(RigHardware& hardware, const RigConfig& rig,
                                             const CameraConfig& camera, std::unique_ptr<CameraSource> source,
                                             const ExtractingSource::FrameTap& tap) {
  auto tampered = std::make_unique<TamperedCamera>(std::move(source), hardware.tampering.back());
  return std::make_unique<ExtractingSource>(std::move(tampered), rig.marker_options, tap,
                                            hardware.orders.back(), camera.model);
}

void addSimulated(RigHardware& hardware, const RigConfig& rig, const CameraConfig& camera,
                  const std::shared_ptr<Clock>& clock, const ExtractingSource::FrameTap& tap) {
  const CameraId id = addCamera(hardware, camera);
  const RigidTransform truth = trueCameraFromWorld(rig, id);
  const MarkerLayout markers = trueMarkers(rig.markers_in_body, rig.simulation);
  const CameraModel model = trueModel(id, camera.model, rig.simulation);
  hardware.disturbances.back().emplace(id, rig.simulation, truth,
                                       randomStream(rig.simulation.seed, RandomStream::kKnocks, id));
  if (rig.simulation.images) {
    auto source =
        std::make_unique<SimulatedCamera>(id, model, truth, markers, rig.marker_options.background_frames,
                                          rig.simulation, hardware.world, clock);
    hardware.sources.push_back(std::make_unique<DisturbedSource>(
        extracted(hardware, rig, camera, std::move(source), tap), camera.model, rig.simulation));
  } else {
    auto source = std::make_unique<SimulatedObserver>(id, model, truth, markers, rig.marker_options,
                                                      rig.simulation, hardware.world, clock);
    auto tampered = std::make_unique<TamperedObserver>(std::move(source), hardware.tampering.back());
    hardware.sources.push_back(std::make_unique<IgnoringSource>(std::move(tampered), hardware.orders.back()));
  }
}

void addDevice(RigHardware& hardware, const RigConfig& rig, const CameraConfig& camera,
               const std::shared_ptr<Clock>& clock, const ExtractingSource::FrameTap& tap) {
  const CameraId id = addCamera(hardware, camera);
  auto source = openDevice(rig, id, clock, hardware.links.back());
  hardware.sources.push_back(extracted(hardware, rig, camera, std::move(source), tap));
}

}  // namespace

RigHardware openRig(const RigConfig& rig, std::shared_ptr<Clock> clock, const ExtractingSource::FrameTap& tap,
                    double carried_s) {
  RigHardware hardware;
  const bool simulated = std::any_of(rig.cameras.begin(), rig.cameras.end(),
                                     [](const CameraConfig& camera) { return camera.source == "sim"; });
  if (simulated) hardware.world = std::make_shared<World>(rig.simulation, rig.helicopter, carried_s);
  for (const CameraConfig& camera : rig.cameras) {
    if (camera.source == "sim")
      addSimulated(hardware, rig, camera, clock, tap);
    else
      addDevice(hardware, rig, camera, clock, tap);
  }
  hardware.transmitter = openTransmitter(rig, hardware.world);
  return hardware;
}

}  // namespace helical
