#include "engine/transmitter/output_process.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstring>
#include <string>
#include <system_error>
#include <thread>

#include "engine/base/error.h"

extern char** environ;

namespace helical {
namespace {

constexpr int kSharedDescriptor = 3;
constexpr TimeNs kRestartAfter = 500 * kNanosecondsPerMillisecond;
constexpr TimeNs kMayStart = 2 * kNanosecondsPerSecond;  // before the first report is due
constexpr TimeNs kLate = 100 * kNanosecondsPerMillisecond;
constexpr int kLongestEndMs = 5000;  // the ramp to rest, and some more

}  // namespace

OutputProcess::OutputProcess(const OutputSettings& settings, std::filesystem::path program)
    : program_(std::move(program)) {
  shared_->settings = settings;
  start();
}

OutputProcess::~OutputProcess() {
  if (pid_ <= 0) return;
  DemandMessage last;
  last.sequence = ++sequence_;
  last.time = systemTime();
  last.quit = true;
  shared_->demand.write(last);
  for (int waited_ms = 0; waited_ms < kLongestEndMs && !hasDied(); ++waited_ms)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  if (pid_ <= 0) return;
  kill(pid_, SIGKILL);
  waitpid(pid_, nullptr, 0);
}

std::filesystem::path OutputProcess::findProgram() {
  std::error_code failure;
  const auto here = std::filesystem::read_symlink("/proc/self/exe", failure).parent_path();
  for (const auto& place : {here / "helical-output", here.parent_path() / "bin" / "helical-output"})
    if (std::filesystem::exists(place, failure)) return place;
  throw Error(ErrorKind::kSystem, "the program helical-output is missing", here.string(),
              "build Helical anew: ./app/run --build-only");
}

void OutputProcess::start() {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, shared_.descriptor(), kSharedDescriptor);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  // Out of our session: what the terminal sends to us must not end it. No signal of ours is blocked there.
  sigset_t none;
  sigemptyset(&none);
  posix_spawnattr_setsigmask(&attributes, &none);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSID | POSIX_SPAWN_SETSIGMASK);
  std::string name = program_.string(), descriptor = std::to_string(kSharedDescriptor);
  char* arguments[] = {name.data(), descriptor.data(), nullptr};
  const int failed = posix_spawn(&pid_, name.c_str(), &actions, &attributes, arguments, environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  started_at_ = systemTime();
  if (failed == 0) return;
  pid_ = -1;
  throw Error(ErrorKind::kSystem, std::string("the output process does not start: ") + std::strerror(failed),
              program_.string(), "build Helical anew: ./app/run --build-only");
}

bool OutputProcess::hasDied() {
  if (pid_ > 0 && waitpid(pid_, nullptr, WNOHANG) == pid_) {
    pid_ = -1;
    died_at_ = systemTime();
  }
  return pid_ <= 0;
}

void OutputProcess::restartInTime(TimeNs now) {
  if (now - died_at_ < kRestartAfter) return;
  ++restarts_;
  try {
    start();
  } catch (const Error&) {
    died_at_ = now;  // and once more later; the status says all the while that it is not there
  }
}

void OutputProcess::send(const StickDemand& demand, TimeNs) {
  const TimeNs now = systemTime();
  DemandMessage message;
  message.sequence = ++sequence_;
  message.time = now;
  message.demand = demand;
  shared_->demand.write(message);

  const bool dead = hasDied();
  if (dead) restartInTime(now);
  shared_->report.read(report_);
  const bool reports = report_.time > started_at_;
  status_ = report_.status;
  status_.present = !dead && report_.status.present && (reports || now - started_at_ < kMayStart);
  status_.self_test_passed = reports && report_.status.self_test_passed;
  status_.fault = dead || report_.status.fault || (reports && now - report_.time > kLate);
}

}  // namespace helical
