#include "engine/pipeline/rig_hardware.h"

#include <algorithm>

#include "engine/base/error.h"
#include "engine/markers/ignoring_source.h"
#include "engine/simulator/disturbed_source.h"
#include "engine/simulator/random_streams.h"
#include "engine/simulator/simulated_camera.h"
#include "engine/simulator/simulated_observer.h"
#include "engine/simulator/simulated_transmitter.h"
#include "engine/transmitter/output_process.h"

namespace helical {
namespace {

template <std::size_t N>
void copyText(const std::string& from, std::array<char, N>& to, const std::string& where) {
  if (from.size() >= N)
    throw Error(ErrorKind::kInput, "'" + from + "' is too long for the output process", where,
                "give a shorter one");
  std::copy(from.begin(), from.end(), to.begin());
}

/// The simulated transmitter behind a real output process: what that puts out is what the helicopter gets.
class LoopbackTransmitter final : public Transmitter {
 public:
  LoopbackTransmitter(const OutputSettings& settings, std::unique_ptr<Transmitter> to_helicopter)
      : process_(settings, OutputProcess::findProgram()), to_helicopter_(std::move(to_helicopter)) {}

  void send(const StickDemand& demand, TimeNs now) override {
    process_.send(demand, now);
    to_helicopter_->send(process_.status().present ? process_.report().output : StickDemand{}, now);
  }
  TransmitterStatus status() const override { return process_.status(); }

 private:
  OutputProcess process_;
  std::unique_ptr<Transmitter> to_helicopter_;
};

std::unique_ptr<Transmitter> openTransmitter(const RigConfig& rig, const std::shared_ptr<World>& world) {
  auto simulated = std::make_unique<SimulatedTransmitter>(rig.simulation, world);
  if (rig.transmitter.kind == "simulated") return simulated;
  OutputSettings settings;
  copyText(rig.transmitter.kind, settings.device, rig.path);
  copyText(rig.transmitter.device, settings.address, rig.path);
  settings.rate_hz = rig.transmitter.rate_hz;
  settings.guard = rig.transmitter.guard;
  return std::make_unique<LoopbackTransmitter>(settings, std::move(simulated));
}

}  // namespace

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
                    const ExtractingSource::FrameTap& tap, double carried_s) {
  RigHardware hardware;
  hardware.world = std::make_shared<World>(rig.simulation, rig.helicopter, carried_s);
  for (std::size_t i = 0; i < rig.cameras.size(); ++i) {
    const CameraConfig& camera = rig.cameras[i];
    if (camera.source != "sim")
      throw Error(ErrorKind::kInput, "camera " + camera.label + " has no source to fly with", rig.path,
                  "give it source = \"sim\"");
    const CameraId id = cameraId(static_cast<int>(i));
    const RigidTransform truth = trueCameraFromWorld(rig, id);
    hardware.boards.push_back(std::make_shared<WhiteBoardsChannel>());
    hardware.orders.push_back(std::make_shared<ExtractorOrders>());
    hardware.orders.back()->ignore(camera.ignored_areas);
    hardware.disturbances.emplace_back(id, rig.simulation, truth,
                                       randomStream(rig.simulation.seed, RandomStream::kKnocks, id));
    if (rig.simulation.images) {
      auto source = std::make_unique<SimulatedCamera>(id, camera.model, truth, rig.markers_in_body,
                                                      rig.marker_options.background_frames, rig.simulation,
                                                      hardware.world, clock);
      auto boarded = std::make_unique<BoardedCamera>(std::move(source), hardware.boards.back());
      auto extracted = std::make_unique<ExtractingSource>(std::move(boarded), rig.marker_options, tap,
                                                          hardware.orders.back(), camera.model);
      hardware.sources.push_back(
          std::make_unique<DisturbedSource>(std::move(extracted), camera.model, rig.simulation));
    } else {
      auto source =
          std::make_unique<SimulatedObserver>(id, camera.model, truth, rig.markers_in_body,
                                              rig.marker_options, rig.simulation, hardware.world, clock);
      auto boarded = std::make_unique<BoardedObserver>(std::move(source), hardware.boards.back());
      hardware.sources.push_back(
          std::make_unique<IgnoringSource>(std::move(boarded), hardware.orders.back()));
    }
  }
  hardware.transmitter = openTransmitter(rig, hardware.world);
  return hardware;
}

}  // namespace helical
