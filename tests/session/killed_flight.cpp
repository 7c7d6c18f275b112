#include <signal.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <new>
#include <thread>

#include "engine/base/check.h"
#include "engine/pipeline/engine.h"
#include "engine/session/recorder.h"
#include "tests/session/session_fixture.h"

/// Flies in real time, recorded to SESSION, in a process that is killed after SECONDS; prints the time of the
/// last control tick that there was while the record went on: what the file lacks of it is lost. With BYTES no
/// file of that process may become larger, as on a disk that is full then; prints also the time of the last
/// tick of all and whether the alarm for the record was raised.
namespace helical {
namespace {

/// What another process sees of the flight.
struct Seen {
  std::atomic<TimeNs> recorded{0};  ///< the last tick before the disk refused
  std::atomic<TimeNs> flown{0};     ///< the last tick
  std::atomic<bool> alarm{false};
};

/// Tells another process how far the flight has come.
class Witness final : public FlightTap {
 public:
  Witness(Recorder& recorder, Seen& seen) : recorder_(recorder), seen_(seen) {}
  void onObservation(const Observation& observation, TimeNs now, const CameraTrack& track) override {
    recorder_.onObservation(observation, now, track);
  }
  void onTick(const OperatorCommands& commands, const EngineSnapshot& state) override {
    recorder_.onTick(commands, state);
    if (!recorder_.failed()) seen_.recorded = state.time;
    seen_.flown = state.time;
    if ((state.alarms & static_cast<std::uint32_t>(Failsafe::kRecord)) != 0) seen_.alarm = true;
  }
  void onHidden(CameraId camera, bool hidden, TimeNs now) override {
    recorder_.onHidden(camera, hidden, now);
  }
  void onCalibration(CameraId camera, const char* method, std::uint64_t seed, TimeNs now) override {
    recorder_.onCalibration(camera, method, seed, now);
  }
  void onCalibrationOrder(const CalibrationOrder& order, TimeNs now) override {
    recorder_.onCalibrationOrder(order, now);
  }
  void onChange(const std::shared_ptr<const FlightChange>& change, TimeNs now) override {
    recorder_.onChange(change, now);
  }
  void onEvent(const EngineEvent& event) override { recorder_.onEvent(event); }
  void onBelief(CameraId camera, const CalibrationView& belief, TimeNs now) override {
    recorder_.onBelief(camera, belief, now);
  }
  void onFrame(const Frame& frame, const Observation& observation) override {
    recorder_.onFrame(frame, observation);
  }
  RecordHealth health() const override { return recorder_.health(); }

 private:
  Recorder& recorder_;
  Seen& seen_;
};

[[noreturn]] void fly(const char* session, std::uint64_t seed, rlim_t bytes, Seen& seen) {
  const SessionSettings settings = test::hoverSettings(seed);
  Recorder recorder(session, settings, Recorder::WhenFull::kDrop);
  if (bytes > 0) {
    const rlimit limit{bytes, bytes};
    HELICAL_CHECK(::setrlimit(RLIMIT_FSIZE, &limit) == 0);
  }
  Witness witness(recorder, seen);
  Engine engine(settings.rig, settings.plan, &witness);
  engine.start();
  bool ordered = false;
  for (EngineSnapshot tick;;) {
    while (engine.nextTick(tick)) {
      if (ordered || tick.failing_checks != 0) continue;
      ordered = true;
      engine.arm();
      engine.takeOff();
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
}

int run(const char* session, std::uint64_t seed, double seconds, rlim_t bytes) {
  void* page = ::mmap(nullptr, sizeof(Seen), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  HELICAL_CHECK(page != MAP_FAILED);
  auto& seen = *new (page) Seen();
  const pid_t pilot = ::fork();
  HELICAL_CHECK(pilot >= 0);
  if (pilot == 0) fly(session, seed, bytes, seen);
  std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
  ::kill(pilot, SIGKILL);
  int status = 0;
  ::waitpid(pilot, &status, 0);
  std::printf("%.9f", toSeconds(seen.recorded));
  if (bytes > 0) std::printf(" %.9f %d", toSeconds(seen.flown), seen.alarm.load() ? 1 : 0);
  std::printf("\n");
  return WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL ? 0 : 1;
}

}  // namespace
}  // namespace helical

int main(int argc, char** argv) {
  if (argc != 4 && argc != 5) return 2;
  return helical::run(argv[1], std::strtoull(argv[2], nullptr, 10), std::strtod(argv[3], nullptr),
                      argc == 5 ? std::strtoull(argv[4], nullptr, 10) : 0);
}
