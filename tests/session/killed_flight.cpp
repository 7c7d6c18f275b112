#include <signal.h>
#include <sys/mman.h>
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
/// last control tick that there was. What the file lacks of it is lost.
namespace helical {
namespace {

/// Tells another process how far the flight has come.
class Witness final : public FlightTap {
 public:
  Witness(FlightTap& recorder, std::atomic<TimeNs>& flown) : recorder_(recorder), flown_(flown) {}
  void onObservation(const Observation& observation, TimeNs now, const CameraTrack& track) override {
    recorder_.onObservation(observation, now, track);
  }
  void onTick(const OperatorCommands& commands, const EngineSnapshot& state) override {
    recorder_.onTick(commands, state);
    flown_ = state.time;
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
  FlightTap& recorder_;
  std::atomic<TimeNs>& flown_;
};

[[noreturn]] void fly(const char* session, std::uint64_t seed, std::atomic<TimeNs>& flown) {
  const SessionSettings settings = test::hoverSettings(seed);
  Recorder recorder(session, settings, Recorder::WhenFull::kDrop);
  Witness witness(recorder, flown);
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

int run(const char* session, std::uint64_t seed, double seconds) {
  void* page =
      ::mmap(nullptr, sizeof(std::atomic<TimeNs>), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  HELICAL_CHECK(page != MAP_FAILED);
  auto& flown = *new (page) std::atomic<TimeNs>(0);
  const pid_t pilot = ::fork();
  HELICAL_CHECK(pilot >= 0);
  if (pilot == 0) fly(session, seed, flown);
  std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
  ::kill(pilot, SIGKILL);
  int status = 0;
  ::waitpid(pilot, &status, 0);
  std::printf("%.9f\n", toSeconds(flown));
  return WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL ? 0 : 1;
}

}  // namespace
}  // namespace helical

int main(int argc, char** argv) {
  if (argc != 4) return 2;
  return helical::run(argv[1], std::strtoull(argv[2], nullptr, 10), std::strtod(argv[3], nullptr));
}
