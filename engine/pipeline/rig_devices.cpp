#include "engine/pipeline/rig_devices.h"

#include <algorithm>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>

#include "engine/base/error.h"
#include "engine/cameras/aravis/aravis_camera.h"
#include "engine/cameras/file/file_camera.h"
#include "engine/cameras/webcam/webcam_camera.h"
#include "engine/simulator/loopback_link.h"
#include "engine/simulator/simulated_transmitter.h"
#include "engine/transmitter/output_process.h"
#include "engine/transmitter/shared_output.h"

namespace helical {
namespace {

constexpr std::string_view kAravis = "aravis:", kFile = "file:", kWebcam = "webcam:";

bool livesInRealTime(const CameraConfig& camera) {
  return !camera.source.empty() && camera.source != "sim" && !camera.source.starts_with(kFile);
}

/// For rigs that only look on.
class NoTransmitter final : public Transmitter {
 public:
  void send(const StickDemand& /*demand*/, TimeNs /*now*/) override {}
  TransmitterStatus status() const override {
    TransmitterStatus status;
    status.self_test_passed = false;  // it must not arm
    return status;
  }
};

/// The simulated transmitter behind a real output process: what that puts out is what the helicopter gets.
class ProcessTransmitter final : public Transmitter {
 public:
  ProcessTransmitter(const OutputSettings& settings, std::unique_ptr<Transmitter> to_helicopter)
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

std::unique_ptr<Transmitter> openOutputProcess(const RigConfig& rig, const std::shared_ptr<World>& world) {
  return std::make_unique<ProcessTransmitter>(outputSettings(rig.transmitter),
                                              std::make_unique<SimulatedTransmitter>(rig.simulation, world));
}

}  // namespace

bool needsRealTime(const RigConfig& rig) {
  return rig.transmitter.kind == "loopback" || rig.transmitter.kind == "output-process" ||
         isUsb(rig.transmitter) || std::any_of(rig.cameras.begin(), rig.cameras.end(), livesInRealTime);
}

bool isOfRecordings(const RigConfig& rig) {
  return std::all_of(rig.cameras.begin(), rig.cameras.end(),
                     [](const CameraConfig& camera) { return camera.source.starts_with(kFile); });
}

std::unique_ptr<CameraSource> openDevice(const RigConfig& rig, CameraId id, std::shared_ptr<Clock> clock,
                                         std::shared_ptr<CameraLink> link) {
  const CameraConfig& camera = rig.cameras[static_cast<std::size_t>(id.index())];
  if (camera.source.starts_with(kAravis))
    return std::make_unique<AravisCamera>(id, camera.source.substr(kAravis.size()), camera.device,
                                          camera.model.width(), camera.model.height(), std::move(clock),
                                          std::move(link));
  if (camera.source.starts_with(kWebcam))
    return std::make_unique<WebcamCamera>(id, camera.source.substr(kWebcam.size()), camera.device,
                                          camera.model.width(), camera.model.height(), std::move(clock),
                                          std::move(link));
  if (camera.source.starts_with(kFile)) {
    // A path beside the rig file, so that both can be moved together.
    const auto file = std::filesystem::path(rig.path).parent_path() / camera.source.substr(kFile.size());
    return std::make_unique<FileCamera>(id, file, camera.device, camera.model.width(), camera.model.height(),
                                        std::move(clock), std::move(link));
  }
  throw Error(ErrorKind::kInput, "camera " + camera.label + " has no source to fly with", rig.path,
              "give it source = \"sim\", \"aravis:ADDRESS-OR-SERIAL\", \"webcam:/dev/video0\" or \"file:PATH\"");
}

std::unique_ptr<Transmitter> openTransmitter(const RigConfig& rig, const std::shared_ptr<World>& world) {
  const std::string& kind = rig.transmitter.kind;
  if (kind == "loopback") return std::make_unique<LoopbackTransmitter>(rig.transmitter.address);
  if (kind == "simulated" && world) return std::make_unique<SimulatedTransmitter>(rig.simulation, world);
  if (kind == "output-process" && world) return openOutputProcess(rig, world);
  if (isUsb(rig.transmitter))
    return std::make_unique<OutputProcess>(outputSettings(rig.transmitter), OutputProcess::findProgram());
  return std::make_unique<NoTransmitter>();
}

}  // namespace helical
