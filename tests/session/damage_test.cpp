#include <gtest/gtest.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <new>

#include "engine/pipeline/lock_step.h"
#include "engine/session/recorder.h"
#include "tests/session/session_exercise.h"
#include "tests/session/session_fixture.h"
#include "tests/session/session_mutations.h"

namespace helical {
namespace {

using test::TemporaryFolder;

// Of the whole process, test included: what a session may make it use is far less.
constexpr rlim_t kMostMemory = rlim_t{1500} << 20;
// Of all mutants of a test together: some thousand times what the sound file takes.
constexpr rlim_t kMostSeconds = 120;
constexpr int kUnexpected = 3;

/// Two seconds of a flight with images of two kinds.
void record(const std::filesystem::path& file) {
  SessionSettings settings = test::hoverSettings(7);
  settings.rig.calibrator = "particle-filter";
  settings.rig.simulation.images = true;
  settings.images = {{ImageQuality::kLossless, 1.0}, {ImageQuality::kJpeg, 4.0}, {}};
  Recorder recorder(file, settings, Recorder::WhenFull::kWait);
  LockStep flight(settings.rig, settings.plan, &recorder);
  for (int i = 0; i < 120; ++i) {
    OperatorCommands commands;
    commands.arm = commands.take_off = i == 60;
    if (i == 90) flight.hideCamera(cameraId(1), true);
    flight.tick(commands);
  }
}

void limitChild() {
#ifndef __SANITIZE_ADDRESS__  // which takes its shadow from the same account
  const rlimit memory{kMostMemory, kMostMemory};
  ::setrlimit(RLIMIT_AS, &memory);
#endif
  const rlimit seconds{kMostSeconds, kMostSeconds};
  ::setrlimit(RLIMIT_CPU, &seconds);
  ::signal(SIGXFSZ, SIG_IGN);
}

/// Runs `one` for 0 to `count` in a process of its own with bounded memory and time; the number at which it
/// ended other than well, -1 if it did not.
int firstFailure(int count, const std::function<void(int)>& one) {
  void* page = ::mmap(nullptr, sizeof(std::atomic<int>), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  auto& at = *new (page) std::atomic<int>(-1);
  const pid_t child = ::fork();
  if (child == 0) {
    limitChild();
    try {
      for (int i = 0; i < count; ++i) {
        at = i;
        one(i);
      }
    } catch (const std::exception& error) {
      std::fprintf(stderr, "%s\n", error.what());
      ::_exit(kUnexpected);
    }
    ::_exit(0);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  const int failed = WIFEXITED(status) && WEXITSTATUS(status) == 0 ? -1 : at.load();
  ::munmap(page, sizeof(std::atomic<int>));
  return failed;
}

/// More of them for who looks for new ones: HELICAL_MUTANTS.
int mutants(int usual) {
  const char* wanted = std::getenv("HELICAL_MUTANTS");
  return wanted != nullptr ? std::atoi(wanted) : usual;
}

class Damage : public testing::Test {
 protected:
  void SetUp() override {
    record(folder_ / "sound.mcap");
    ASSERT_EQ(test::exerciseSession(folder_ / "sound.mcap", folder_ / ""), 0);
  }
  const TemporaryFolder folder_;
};

TEST_F(Damage, OfBytesNeverCrashesHangsOrEatsTheMemory) {
  const std::string sound = test::bytesOf(folder_ / "sound.mcap");
  const int failed = firstFailure(mutants(100), [&](int i) {
    Random random(1000 + static_cast<std::uint64_t>(i));
    test::writeBytes(folder_ / "mutant.mcap", test::mutateBytes(sound, random));
    test::exerciseSession(folder_ / "mutant.mcap", folder_ / "");
  });
  EXPECT_EQ(failed, -1) << "the mutant of this seed";
}

TEST_F(Damage, OfWhatItSaysNeverCrashesHangsOrEatsTheMemory) {
  const int failed = firstFailure(mutants(50), [&](int i) {
    Random random(2000 + static_cast<std::uint64_t>(i));
    test::mutateContent(folder_ / "sound.mcap", folder_ / "mutant.mcap", random);
    test::exerciseSession(folder_ / "mutant.mcap", folder_ / "");
  });
  EXPECT_EQ(failed, -1) << "the mutant of this seed";
}

TEST_F(Damage, OfForeignFilesIsRefused) {
  const int failed = firstFailure(40, [&](int i) {
    Random random(3000 + static_cast<std::uint64_t>(i));
    std::string bytes(static_cast<std::size_t>(random.uniform(0.0, 5000.0)), '\0');
    for (char& byte : bytes) byte = static_cast<char>(random.uniform(0.0, 255.9));
    if (i % 2 == 0) bytes.insert(0, std::string(kMcapMagic));
    test::writeBytes(folder_ / "foreign.mcap", bytes);
    const int refused = test::exerciseSession(folder_ / "foreign.mcap", folder_ / "");
    if (refused < 4) throw std::runtime_error("a foreign file was taken for a session");
  });
  EXPECT_EQ(failed, -1) << "the file of this seed";
}

}  // namespace
}  // namespace helical
