#include "engine/pipeline/rig_devices.h"

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>

#include "engine/base/error.h"
#include "engine/cameras/aravis/aravis_camera.h"
#include "engine/simulator/loopback_link.h"
#include "engine/simulator/simulated_transmitter.h"

namespace helical {
namespace {

constexpr std::string_view kAravis = "aravis:";

/// For rigs that only look on.
class NoTransmitter final : public Transmitter {
 public:
  void send(const StickDemand& /*demand*/, TimeNs /*now*/) override {}
};

}  // namespace

bool needsRealTime(const RigConfig& rig) {
  return rig.transmitter == "loopback" || std::any_of(rig.cameras.begin(), rig.cameras.end(), [](const auto& camera) {
           return !camera.source.empty() && camera.source != "sim";
         });
}

std::unique_ptr<CameraSource> openDevice(const RigConfig& rig, CameraId id, std::shared_ptr<Clock> clock,
                                         std::shared_ptr<CameraLink> link) {
  const CameraConfig& camera = rig.cameras[static_cast<std::size_t>(id.index())];
  if (camera.source.starts_with(kAravis))
    return std::make_unique<AravisCamera>(id, camera.source.substr(kAravis.size()), camera.device,
                                          camera.model.width(), camera.model.height(), std::move(clock),
                                          std::move(link));
  throw Error(ErrorKind::kInput, "camera " + camera.label + " has no source to fly with", rig.path,
              "give it source = \"sim\" or \"aravis:ADDRESS-OR-SERIAL\"");
}

std::unique_ptr<Transmitter> openTransmitter(const RigConfig& rig, const std::shared_ptr<World>& world) {
  if (rig.transmitter == "loopback") return std::make_unique<LoopbackTransmitter>(rig.transmitter_address);
  if (rig.transmitter == "simulated" && world) return std::make_unique<SimulatedTransmitter>(rig.simulation, world);
  return std::make_unique<NoTransmitter>();
}

}  // namespace helical
