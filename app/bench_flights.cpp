#include "app/bench_flights.h"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <thread>
#include <vector>

#include "engine/base/error.h"
#include "engine/pipeline/engine.h"

namespace helical {
namespace {

/// Every pixel keeps one of its three colours.
void toMosaic(const ImageView& bgr, std::vector<std::uint8_t>& mosaic) {
  const auto width = static_cast<std::size_t>(bgr.width);
  mosaic.resize(width * static_cast<std::size_t>(bgr.height));
  for (int y = 0; y < bgr.height; ++y) {
    const std::uint8_t* row = bgr.row(y);
    std::uint8_t* out = mosaic.data() + static_cast<std::size_t>(y) * width;
    const std::size_t even = y % 2 == 0 ? 2 : 1, odd = y % 2 == 0 ? 1 : 0;  // R G, G B
    for (std::size_t x = 0; x + 1 < width; x += 2) {
      out[x] = row[3 * x + even];
      out[x + 1] = row[3 * (x + 1) + odd];
    }
  }
}

/// Passes on to a recorder, if there is one.
class MosaicTap final : public FlightTap {
 public:
  explicit MosaicTap(FlightTap* recorder) : recorder_(recorder) {}

  void onObservation(const Observation& observation, TimeNs now, const CameraTrack& track) override {
    if (recorder_ != nullptr) recorder_->onObservation(observation, now, track);
  }
  void onTick(const OperatorCommands& commands, const EngineSnapshot& state) override {
    if (recorder_ != nullptr) recorder_->onTick(commands, state);
  }
  void onHidden(CameraId camera, bool hidden, TimeNs now) override {
    if (recorder_ != nullptr) recorder_->onHidden(camera, hidden, now);
  }
  void onCalibration(CameraId camera, const char* method, std::uint64_t seed, TimeNs now) override {
    if (recorder_ != nullptr) recorder_->onCalibration(camera, method, seed, now);
  }
  void onCalibrationOrder(const CalibrationOrder& order, TimeNs now) override {
    if (recorder_ != nullptr) recorder_->onCalibrationOrder(order, now);
  }
  void onChange(const std::shared_ptr<const FlightChange>& change, TimeNs now) override {
    if (recorder_ != nullptr) recorder_->onChange(change, now);
  }
  void onEvent(const EngineEvent& event) override {
    if (recorder_ != nullptr) recorder_->onEvent(event);
  }
  void onBelief(CameraId camera, const CalibrationView& belief, TimeNs now) override {
    if (recorder_ != nullptr) recorder_->onBelief(camera, belief, now);
  }
  void onFrame(const Frame& frame, const Observation& observation) override {
    std::vector<std::uint8_t>& mosaic = mosaics_[static_cast<std::size_t>(frame.camera.index())];
    toMosaic(frame.image, mosaic);
    Frame passed = frame;
    passed.image = {mosaic.data(), frame.image.width, frame.image.height, frame.image.width,
                    PixelFormat::kBayerRg8};
    if (recorder_ != nullptr) recorder_->onFrame(passed, observation);
  }
  RecordHealth health() const override {
    return recorder_ != nullptr ? recorder_->health() : RecordHealth{};
  }

 private:
  FlightTap* recorder_;
  std::array<std::vector<std::uint8_t>, kMaxCameras> mosaics_;  ///< each of its camera's thread
};

}  // namespace

EngineSnapshot flyForBench(const RigConfig& rig, const FlightPlan& plan, double seconds, FlightTap* recorder) {
  MosaicTap tap(recorder);
  Engine engine(rig, plan, &tap);
  engine.start();
  EngineSnapshot now;
  for (bool ordered = false; toSeconds(now.time) < seconds;) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    while (engine.nextTick(now)) {
      if (ordered || !now.pose_known || now.failing_checks != 0) continue;
      ordered = true;
      engine.arm();
      engine.takeOff();
    }
  }
  engine.stop();
  return now;
}

void forgetFile(const std::filesystem::path& file) {
  const int descriptor = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return;
  static_cast<void>(::fsync(descriptor));
  static_cast<void>(::posix_fadvise(descriptor, 0, 0, POSIX_FADV_DONTNEED));
  ::close(descriptor);
}

ScratchFolder::ScratchFolder(const std::filesystem::path& parent) {
  std::string name = (parent / "helical-bench-XXXXXX").string();
  if (::mkdtemp(name.data()) == nullptr)
    throw Error(ErrorKind::kInput, std::string("no folder can be made here: ") + std::strerror(errno), parent.string(),
                "name one that can be written to with --folder");
  path_ = name;
}

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

}  // namespace helical
