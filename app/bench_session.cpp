#include "app/bench_session.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

#include "app/bench_flights.h"
#include "app/bench_report.h"
#include "app/progress.h"
#include "engine/base/clock.h"
#include "engine/base/random.h"
#include "engine/config/plan_file.h"
#include "engine/config/resource_files.h"
#include "engine/config/rig_file.h"
#include "engine/config/text_file.h"
#include "engine/experiments/statistics.h"
#include "engine/pipeline/lock_step.h"
#include "engine/session/flight_playback.h"
#include "engine/session/recorder.h"

namespace helical {
namespace {

using Json = nlohmann::ordered_json;

struct Arguments {
  int blocks = 6;
  double block_s = 20.0;
  double long_s = 3600.0;
  int scrubs = 200;
  std::string folder = std::filesystem::temp_directory_path();
  bool json = false;
};

SessionSettings hover(bool images) {
  const std::filesystem::path rig = resourceFolder() / "rigs" / "paper.toml";
  SessionSettings settings;
  settings.rig_text = readTextFile(rig, "rig file");
  settings.plan_text = readTextFile(planPath("hover"), "flight plan");
  settings.rig = loadRig(rig);
  settings.rig.simulation.images = images;
  settings.plan = loadPlan(planPath("hover"));
  settings.realtime = images;
  if (images) settings.images.assign(settings.rig.cameras.size(), {ImageQuality::kLossless, 0.0});
  return settings;
}

/// One way of flying, in all of its blocks.
struct Arm {
  std::vector<double> p50_us, p99_us;
  std::uint64_t frames = 0, dropped = 0, lost = 0, lost_images = 0, bytes = 0;
  double seconds = 0.0;

  void add(const EngineSnapshot& last) {
    p50_us.push_back(1e-3 * static_cast<double>(last.server_p50));
    p99_us.push_back(1e-3 * static_cast<double>(last.server_p99));
    for (const CameraSnapshot& camera : last.cameras) {
      frames += camera.frames;
      dropped += camera.dropped;
    }
    seconds += toSeconds(last.time);
  }
  Json report() const {
    return {{"server_us",
             {{"p50", quantile(p50_us, 0.5)}, {"p99", quantile(p99_us, 0.5)}, {"p99_of_blocks", p99_us}}},
            {"frames", frames},
            {"frames_dropped", dropped}};
  }
};

Json measureRecording(const Arguments& arguments, const std::filesystem::path& folder) {
  const SessionSettings settings = hover(true);
  Arm alone, recorded;
  Progress progress("Recording three cameras");
  for (int block = 0; block < arguments.blocks; ++block) {
    progress.update(static_cast<double>(block) / arguments.blocks);
    const bool records = block % 2 == 1;
    const std::filesystem::path file = folder / "block.mcap";
    std::unique_ptr<Recorder> recorder;
    if (records) recorder = std::make_unique<Recorder>(file, settings, Recorder::WhenFull::kDrop);
    Arm& arm = records ? recorded : alone;
    arm.add(flyForBench(settings.rig, settings.plan, arguments.block_s, recorder.get()));
    if (!recorder) continue;
    recorder->finish();
    arm.lost += recorder->lost();
    arm.lost_images += recorder->lostImages();
    arm.bytes += std::filesystem::file_size(file);
    std::filesystem::remove(file);
  }
  Json with = recorded.report();
  with["messages_lost"] = recorded.lost;
  with["images_lost"] = recorded.lost_images;
  with["megabytes_per_minute"] = 60e-6 * static_cast<double>(recorded.bytes) / recorded.seconds;
  const double with_p99 = quantile(recorded.p99_us, 0.5), without_p99 = quantile(alone.p99_us, 0.5);
  return {{"cameras", settings.rig.cameras.size()},
          {"images", "bayer_rggb8, lossless, 60 Hz"},
          {"block_s", arguments.block_s},
          {"blocks", arguments.blocks},
          {"without", alone.report()},
          {"with", with},
          {"server_p99_with_over_without", with_p99 / without_p99},
          {"server_p99_difference_us", with_p99 - without_p99},
          {"server_p99_allowed_us", 1.25 * without_p99 + 200.0}};
}

/// Without images and as fast as the machine allows.
void recordLong(const std::filesystem::path& file, double seconds) {
  const SessionSettings settings = hover(false);
  Recorder recorder(file, settings, Recorder::WhenFull::kWait);
  LockStep flight(settings.rig, settings.plan, &recorder);
  Progress progress("A long flight");
  OperatorCommands commands;
  bool ordered = false;
  for (std::uint64_t tick = 0; static_cast<double>(tick) < seconds * settings.rig.control.rate_hz; ++tick) {
    const EngineSnapshot& now = flight.tick(commands);
    commands.arm = commands.take_off = !ordered && now.pose_known && now.failing_checks == 0;
    ordered = ordered || commands.arm;
    if (tick % 600 == 0) progress.update(toSeconds(now.time) / seconds);
  }
  recorder.finish();
}

Json measureLong(const Arguments& arguments, const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / "long.mcap";
  recordLong(file, arguments.long_s);
  const MonotonicClock stopwatch;
  forgetFile(file);
  const auto open = [&] {
    const TimeNs begin = stopwatch.now();
    auto playback = std::make_unique<FlightPlayback>(file, std::make_shared<ManualClock>());
    return std::pair(1e-6 * static_cast<double>(stopwatch.now() - begin), std::move(playback));
  };
  const double cold_ms = open().first;
  const auto [warm_ms, playback] = open();
  std::vector<double> scrubs_ms;
  EngineSnapshot tick;
  Random random(1);
  for (int i = 0; i < arguments.scrubs; ++i) {
    const double share = random.uniform(0.0, 1.0);
    const TimeNs to = playback->begin() +
                      static_cast<TimeNs>(share * static_cast<double>(playback->end() - playback->begin()));
    const TimeNs begin = stopwatch.now();
    playback->seek(to);
    for (std::size_t c = 0; c < playback->rig().cameras.size(); ++c)
      playback->pollPicture(cameraId(static_cast<int>(c)));
    while (playback->nextTick(tick)) {  // as the window does for its plots
    }
    scrubs_ms.push_back(1e-6 * static_cast<double>(stopwatch.now() - begin));
  }
  return {{"length_s", toSeconds(playback->end())},
          {"megabytes", 1e-6 * static_cast<double>(std::filesystem::file_size(file))},
          {"open_ms", {{"cold", cold_ms}, {"warm", warm_ms}}},
          {"scrub_ms",
           {{"median", quantile(scrubs_ms, 0.5)},
            {"p99", quantile(scrubs_ms, 0.99)},
            {"max", quantile(scrubs_ms, 1.0)}}}};
}

void run(const Arguments& arguments) {
  const ScratchFolder folder(arguments.folder);
  Json report;
  if (arguments.blocks > 0) report["recording"] = measureRecording(arguments, folder.path());
  if (arguments.long_s > 0.0) report["long_session"] = measureLong(arguments, folder.path());
  printBenchReport(report, arguments.json);
}

}  // namespace

void addSessionBench(CLI::App& app) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command =
      app.add_subcommand("session", "Recorded flights beside those that nobody records; long sessions");
  command->add_option("--blocks", arguments->blocks, "Flights, every second one recorded; 0: none")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  command->add_option("--block", arguments->block_s, "Length of each [s]")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command->add_option("--long", arguments->long_s, "Length of the session that is opened [s]; 0: none")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  command->add_option("--scrubs", arguments->scrubs, "Places that are sought in it")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command->add_option("--folder", arguments->folder, "Whose disk is written to")->capture_default_str();
  command->add_flag("--json", arguments->json, "Print one JSON object");
  command->callback([arguments] { run(*arguments); });
}

}  // namespace helical
