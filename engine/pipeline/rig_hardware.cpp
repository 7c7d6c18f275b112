#include "engine/pipeline/rig_hardware.h"

#include "engine/base/error.h"
#include "engine/simulator/disturbed_source.h"
#include "engine/simulator/random_streams.h"
#include "engine/simulator/simulated_camera.h"
#include "engine/simulator/simulated_observer.h"
#include "engine/simulator/simulated_transmitter.h"

namespace helical {

void RigHardware::addTruth(EngineSnapshot& snapshot, TimeNs now) const {
  if (!world) return;
  world->advanceTo(now);
  for (std::size_t i = 0; i < disturbances.size(); ++i) {
    CameraSnapshot& camera = snapshot.cameras[i];
    camera.has_truth = true;
    camera.true_camera_from_world =
        world->knocked(cameraId(static_cast<int>(i)), disturbances[i].cameraFromWorld(toSeconds(now)));
  }
  const auto truth = world->at(now);
  if (!truth) return;
  snapshot.has_truth = true;
  snapshot.truth = truth->state;
  snapshot.verdict = world->verdict();
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

RigHardware openRig(const RigConfig& rig, std::shared_ptr<Clock> clock,
                    const ExtractingSource::FrameTap& tap) {
  RigHardware hardware;
  hardware.world = std::make_shared<World>(rig.simulation, rig.helicopter);
  for (std::size_t i = 0; i < rig.cameras.size(); ++i) {
    const CameraConfig& camera = rig.cameras[i];
    if (camera.source != "sim")
      throw Error(ErrorKind::kInput, "camera " + camera.label + " has no source to fly with", rig.path,
                  "give it source = \"sim\"");
    const CameraId id = cameraId(static_cast<int>(i));
    const RigidTransform truth = trueCameraFromWorld(rig, id);
    hardware.tampering.push_back(std::make_shared<TamperingChannel>());
    hardware.extraction.push_back(std::make_shared<ExtractionChannel>());
    hardware.disturbances.emplace_back(id, rig.simulation, truth,
                                       randomStream(rig.simulation.seed, RandomStream::kKnocks, id));
    if (rig.simulation.images) {
      auto source = std::make_unique<SimulatedCamera>(id, camera.model, truth, rig.markers_in_body,
                                                      rig.marker_options.background_frames, rig.simulation,
                                                      hardware.world, clock);
      auto tampered = std::make_unique<TamperedCamera>(std::move(source), hardware.tampering.back());
      auto extracted = std::make_unique<ExtractingSource>(std::move(tampered), rig.marker_options, tap,
                                                          hardware.extraction.back());
      hardware.sources.push_back(
          std::make_unique<DisturbedSource>(std::move(extracted), camera.model, rig.simulation));
    } else {
      auto source =
          std::make_unique<SimulatedObserver>(id, camera.model, truth, rig.markers_in_body,
                                              rig.marker_options, rig.simulation, hardware.world, clock);
      hardware.sources.push_back(
          std::make_unique<TamperedObserver>(std::move(source), hardware.tampering.back()));
    }
  }
  hardware.transmitter = std::make_unique<SimulatedTransmitter>(rig.simulation, hardware.world);
  return hardware;
}

}  // namespace helical
