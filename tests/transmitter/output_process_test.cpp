// The output process with real processes: a ground station that is killed, stopped, goes on; and the
// process's own death. No time is measured here: the log says when what was put out, on the clock on which it
// was killed.

#include "engine/transmitter/output_process.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

namespace helical {
namespace {

constexpr TimeNs kNeutralWithin = 150 * kNanosecondsPerMillisecond;

int kills() {
  const char* wanted = std::getenv("HELICAL_KILLS");
  return wanted != nullptr ? std::atoi(wanted) : 5;
}

void pause() {
  std::this_thread::sleep_for(std::chrono::milliseconds(5));
}

/// Generous, for slow and busy machines.
bool eventually(const std::function<bool()>& condition) {
  const auto give_up = std::chrono::steady_clock::now() + std::chrono::seconds(120);
  while (std::chrono::steady_clock::now() < give_up) {
    if (condition()) return true;
    pause();
  }
  return false;
}

struct Line {
  TimeNs time = 0;
  StickDemand output;
  int beat = 0;
};

class Log {
 public:
  Log() : folder_(std::filesystem::temp_directory_path() / ("helical_output_" + std::to_string(getpid()))) {
    std::filesystem::create_directories(folder_);
    std::filesystem::remove(file());
  }
  ~Log() { std::filesystem::remove_all(folder_); }
  std::string file() const { return (folder_ / "log").string(); }
  /// Whole lines only: the last one may be in the making.
  std::vector<Line> lines() const {
    std::ifstream stream(file());
    std::vector<Line> all;
    for (std::string text; std::getline(stream, text) && !stream.eof();) {
      std::istringstream in(text);
      Line line;
      in >> line.time >> line.output.upper_rotor >> line.output.lower_rotor >> line.output.roll >>
          line.output.pitch >> line.beat;
      all.push_back(line);
    }
    return all;
  }
  bool flies() const {
    const auto all = lines();
    return !all.empty() && all.back().output.upper_rotor > 0.0;
  }
  bool rests() const {
    const auto all = lines();
    return !all.empty() && all.back().output == StickDemand{};
  }

 private:
  std::filesystem::path folder_;
};

/// A ground station as a child process; its output process as grandchild.
class GroundStation {
 public:
  explicit GroundStation(const Log& log) {
    int ends[2];
    EXPECT_EQ(pipe(ends), 0);
    pid_ = fork();
    if (pid_ == 0) {
      dup2(ends[1], STDOUT_FILENO);
      const std::string file = log.file();
      execl(HELICAL_GROUND_STATION, HELICAL_GROUND_STATION, HELICAL_OUTPUT_PROGRAM, file.c_str(), nullptr);
      _exit(127);
    }
    close(ends[1]);
    FILE* said = fdopen(ends[0], "r");
    EXPECT_EQ(std::fscanf(said, "%d", &output_), 1);
    std::fclose(said);
  }
  ~GroundStation() {
    send(SIGCONT);
    send(SIGKILL);
    waitpid(pid_, nullptr, 0);
  }
  TimeNs send(int signal_number) const {
    kill(pid_, signal_number);
    return systemTime();
  }
  /// What has ended counts as gone, whether or not somebody has taken note of it.
  bool outputRuns() const {
    std::ifstream stat("/proc/" + std::to_string(output_) + "/stat");
    std::string pid, name, state;
    return (stat >> pid >> name >> state) && state != "Z";
  }

 private:
  pid_t pid_ = -1;
  int output_ = -1;
};

void expectNeutralThenRest(const Log& log, TimeNs since) {
  double throttle = 1.0;
  int after = 0;
  for (const Line& line : log.lines()) {
    if (line.time <= since + kNeutralWithin) continue;
    ++after;
    EXPECT_EQ(line.output.roll, 0.0);
    EXPECT_EQ(line.output.pitch, 0.0);
    EXPECT_LE(line.output.upper_rotor, throttle + 1e-9) << "never up again";
    throttle = line.output.upper_rotor;
  }
  EXPECT_GT(after, 10);
  EXPECT_EQ(throttle, 0.0);
}

TEST(OutputProcessKills, AGroundStationThatIsKilledLeavesTheSticksAtRest) {
  for (int i = 0; i < kills(); ++i) {
    const Log log;
    GroundStation station(log);
    ASSERT_TRUE(eventually([&] { return log.flies(); }));
    const TimeNs killed = station.send(SIGKILL);
    ASSERT_TRUE(eventually([&] { return log.rests(); }));
    ASSERT_TRUE(eventually([&] { return !station.outputRuns(); }))
        << "it ends when it has nothing more to do";
    expectNeutralThenRest(log, killed);
  }
}

TEST(OutputProcessKills, AGroundStationThatStandsStillLosesTheSticksAndDoesNotGetThemBackByItself) {
  for (int i = 0; i < kills(); ++i) {
    const Log log;
    GroundStation station(log);
    ASSERT_TRUE(eventually([&] { return log.flies(); }));
    const TimeNs stopped = station.send(SIGSTOP);
    ASSERT_TRUE(eventually([&] { return log.rests(); }));
    const std::size_t before = log.lines().size();
    station.send(SIGCONT);  // it goes on where it was, with flying sticks
    ASSERT_TRUE(eventually([&] { return log.lines().size() > before + 20; }));
    EXPECT_TRUE(station.outputRuns());
    expectNeutralThenRest(log, stopped);
  }
}

OutputSettings loopback(const Log& log) {
  OutputSettings settings;
  std::strncpy(settings.device.data(), "loopback", settings.device.size() - 1);
  std::strncpy(settings.address.data(), log.file().c_str(), settings.address.size() - 1);
  return settings;
}

/// Sends until `condition` holds.
bool sendUntil(OutputProcess& output, const StickDemand& demand, const std::function<bool()>& condition) {
  return eventually([&] {
    output.send(demand, 0);
    return condition();
  });
}

constexpr StickDemand kFlying{0.4, 0.4, 0.1, 0.1};

TEST(OutputProcess, ItsDeathIsAnAlarmAtOnceAndTheNextOneIsLocked) {
  const Log log;
  OutputProcess output(loopback(log), HELICAL_OUTPUT_PROGRAM);
  ASSERT_TRUE(sendUntil(output, {}, [&] { return !output.report().locked; }));
  ASSERT_TRUE(sendUntil(output, kFlying, [&] { return output.report().output == kFlying; }));
  EXPECT_TRUE(output.status().present);
  EXPECT_FALSE(output.status().fault);
  const pid_t first = output.pid();
  ASSERT_EQ(kill(first, SIGKILL), 0);
  siginfo_t died{};
  ASSERT_EQ(waitid(P_PID, static_cast<id_t>(first), &died, WEXITED | WNOWAIT), 0);
  output.send(kFlying, 0);
  EXPECT_FALSE(output.status().present) << "with the first demand that it does not take";
  EXPECT_TRUE(output.status().fault);

  const std::size_t before = log.lines().size();
  ASSERT_TRUE(sendUntil(output, kFlying, [&] { return log.lines().size() > before + 20; }));
  EXPECT_EQ(output.restarts(), 1);
  EXPECT_NE(output.pid(), first);
  ASSERT_TRUE(sendUntil(output, kFlying, [&] { return output.status().present && !output.status().fault; }));
  EXPECT_TRUE(output.report().locked);
  const auto lines = log.lines();
  for (std::size_t i = before; i < lines.size(); ++i) EXPECT_EQ(lines[i].output, StickDemand{});
  ASSERT_TRUE(sendUntil(output, {}, [&] { return !output.report().locked; })) << "a rest unlocks it";
  ASSERT_TRUE(sendUntil(output, kFlying, [&] { return output.report().output == kFlying; }));
}

TEST(OutputProcess, TogglesItsHeartbeatWithEachDemand) {
  const Log log;
  OutputProcess output(loopback(log), HELICAL_OUTPUT_PROGRAM);
  ASSERT_TRUE(sendUntil(output, {}, [&] { return log.lines().size() > 20; }));
  const auto lines = log.lines();
  for (std::size_t i = 1; i < lines.size(); ++i) EXPECT_NE(lines[i].beat, lines[i - 1].beat);
}

TEST(OutputProcess, EndsWithItsGroundStationAndNotByTheKeysOfATerminal) {
  const Log log;
  pid_t pid = -1;
  {
    OutputProcess output(loopback(log), HELICAL_OUTPUT_PROGRAM);
    ASSERT_TRUE(sendUntil(output, {}, [&] { return !output.report().locked; }));
    pid = output.pid();
    for (const int number : {SIGINT, SIGHUP, SIGQUIT}) ASSERT_EQ(kill(pid, number), 0);
    const std::uint64_t reports = output.report().sequence;
    ASSERT_TRUE(sendUntil(output, kFlying, [&] { return output.report().sequence > reports + 10; }));
    EXPECT_EQ(output.report().output, kFlying);
  }
  EXPECT_EQ(kill(pid, 0), -1);
  EXPECT_EQ(errno, ESRCH);
  EXPECT_TRUE(log.rests());
}

TEST(OutputProcess, ADeviceThatIsNotThereIsAnAlarm) {
  const Log log;
  OutputSettings settings = loopback(log);
  std::strncpy(settings.address.data(), "/no/such/folder/log", settings.address.size() - 1);
  OutputProcess output(settings, HELICAL_OUTPUT_PROGRAM);
  ASSERT_TRUE(sendUntil(output, {}, [&] { return !output.status().present; }));
  EXPECT_FALSE(output.status().self_test_passed);
  ASSERT_TRUE(sendUntil(output, {}, [&] { return output.restarts() > 1; })) << "it is tried again";
}

}  // namespace
}  // namespace helical
