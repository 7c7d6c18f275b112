#include "app/bench_pipeline.h"

#include <Eigen/Geometry>
#include <QApplication>
#include <QElapsedTimer>
#include <QKeyEvent>
#include <QTimer>
#include <QWindow>
#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "app/bench_report.h"
#include "app/display.h"
#include "engine/config/plan_file.h"
#include "engine/config/resource_files.h"
#include "engine/config/rig_file.h"
#include "engine/experiments/statistics.h"
#include "engine/pipeline/engine.h"
#include "ui/camera_pane.h"
#include "ui/camera_view.h"
#include "ui/camera_wall.h"
#include "ui/main_window.h"
#include "ui/scene_view.h"
#include "ui/status_words.h"
#include "ui/theme.h"

namespace helical {
namespace {

constexpr int kManyCameras = 16;
constexpr double kSettleS = 4.0;  // backgrounds, OpenGL, take-off: seen once a flight

struct Options {
  bool json = false;
  double block_s = 20.0;
  int blocks = 3;  ///< of each kind
};

/// What one block of flight cost.
struct Block {
  double server_p50_us = 0.0;
  double server_p99_us = 0.0;
  std::uint64_t dropped = 0;
  std::uint64_t lost_ticks = 0;
  bool flew = false;
  double gui_hz = 0.0;      ///< the window looked at the engine and showed what had come
  double picture_hz = 0.0;  ///< the first camera's pane was painted
  double scene_hz = 0.0;
};

/// How often the window has done what, to tell rates from.
struct Counts {
  explicit Counts(const MainWindow& window)
      : refreshes(static_cast<double>(window.refreshes())),
        pictures(window.cameras().pane(0).view().paints()),
        scenes(window.scene().renderedFrames()) {}
  double refreshes;
  double pictures;
  double scenes;
};

FlightPlan longHover() {
  FlightPlan plan = loadPlan(planPath("hover"));
  plan.land_at_s = 1e6;
  return plan;
}

std::uint64_t droppedFrames(const EngineSnapshot& now) {
  std::uint64_t dropped = 0;
  for (int i = 0; i < now.camera_count; ++i) dropped += now.cameras[static_cast<std::size_t>(i)].dropped;
  return dropped;
}

/// Events of the window, and the engine's snapshots, for so long.
void run(Engine& engine, double seconds, bool fetch) {
  QElapsedTimer timer;
  timer.start();
  bool ordered = false;
  while (static_cast<double>(timer.elapsed()) < 1e3 * seconds) {
    QCoreApplication::processEvents(QEventLoop::AllEvents | QEventLoop::WaitForMoreEvents, 20);
    if (fetch) {
      engine.poll();
      EngineSnapshot tick;
      while (engine.nextTick(tick)) {
      }
    }
    if (ordered || !engine.snapshot().pose_known || engine.snapshot().failing_checks != 0) continue;
    engine.arm();
    engine.takeOff();
    ordered = true;
  }
}

Block measure(const RigConfig& rig, double seconds, bool with_window) {
  Engine engine(rig, longHover());
  std::unique_ptr<MainWindow> window;
  QTimer beat;  // or processEvents would sleep on, without a window
  beat.start(10);
  Block block;
  if (with_window) {
    window = std::make_unique<MainWindow>(rig, WindowOptions{});
    window->fitToScreen();
    window->show();
  }
  engine.start();
  if (window) window->attach(engine);
  run(engine, kSettleS, !window);
  const std::uint64_t dropped = droppedFrames(engine.snapshot());
  const std::optional<Counts> before = window ? std::optional<Counts>(*window) : std::nullopt;
  run(engine, seconds, !window);
  const EngineSnapshot& end = engine.snapshot();
  block.server_p50_us = 1e6 * toSeconds(end.server_p50);
  block.server_p99_us = 1e6 * toSeconds(end.server_p99);
  block.dropped = droppedFrames(end) - dropped;
  block.lost_ticks = engine.lostTicks();
  block.flew = inFlight(end.phase);
  if (window) {
    const Counts after(*window);
    block.gui_hz = (after.refreshes - before->refreshes) / seconds;
    block.picture_hz = (after.pictures - before->pictures) / seconds;
    block.scene_hz = (after.scenes - before->scenes) / seconds;
    window->detach();
  }
  engine.kill();
  return block;
}

RigConfig manyCameras() {
  RigConfig rig = loadRig(resourceFolder() / "rigs" / "paper.toml");
  rig.simulation.images = false;
  const CameraConfig first = rig.cameras.front();
  rig.cameras.clear();
  rig.simulation.true_camera_from_world.assign(kManyCameras, std::nullopt);
  for (int i = 0; i < kManyCameras; ++i) {
    CameraConfig camera = first;
    camera.label = std::to_string(i + 1);
    camera.name = "Camera " + camera.label;
    RigidTransform turned;
    turned.rotation = Eigen::AngleAxisd(2.0 * 3.14159265358979 * i / kManyCameras, Eigen::Vector3d::UnitZ());
    camera.camera_from_world = *first.camera_from_world * turned;
    rig.cameras.push_back(camera);
  }
  return rig;
}

/// From the key's way into the window's queue to the engine's answer.
nlohmann::ordered_json sixteenPanes(double seconds) {
  const RigConfig rig = manyCameras();
  Engine engine(rig, longHover());
  MainWindow window(rig, WindowOptions{});
  window.fitToScreen();
  window.show();
  engine.start();
  window.attach(engine);
  run(engine, kSettleS, false);
  const Counts before(window);
  run(engine, seconds, false);
  const Counts after(window);
  QElapsedTimer since;
  since.start();
  QCoreApplication::postEvent(window.windowHandle(),
                              new QKeyEvent(QEvent::KeyPress, Qt::Key_Escape, Qt::NoModifier));
  while (engine.snapshot().safety != SafetyState::kCut && since.elapsed() < 10'000)
    QCoreApplication::processEvents(QEventLoop::AllEvents | QEventLoop::WaitForMoreEvents, 5);
  const double stop_ms = static_cast<double>(since.nsecsElapsed()) * 1e-6;
  window.detach();
  return {{"cameras", kManyCameras},
          {"gui_hz", (after.refreshes - before.refreshes) / seconds},
          {"picture_hz", (after.pictures - before.pictures) / seconds},
          {"scene_hz", (after.scenes - before.scenes) / seconds},
          {"stop_ms", stop_ms}};
}

template <class Value>
double medianOf(const std::vector<Block>& blocks, Value Block::*value) {
  std::vector<double> values;
  for (const Block& block : blocks) values.push_back(static_cast<double>(block.*value));
  return quantile(values, 0.5);
}

nlohmann::ordered_json summary(const std::vector<Block>& blocks) {
  std::uint64_t dropped = 0, lost = 0;
  for (const Block& block : blocks) {
    dropped += block.dropped;
    lost += block.lost_ticks;
  }
  return {{"p50", medianOf(blocks, &Block::server_p50_us)},
          {"p99", medianOf(blocks, &Block::server_p99_us)},
          {"dropped", dropped},
          {"lost_ticks", lost},
          {"flew", std::all_of(blocks.begin(), blocks.end(), [](const Block& block) { return block.flew; })}};
}

void bench(const Options& options) {
  prepareDisplay();
  int argc = 1;
  char name[] = "helical-bench";
  char* argv[] = {name, nullptr};
  QApplication application(argc, argv);
  theme::apply(application);
  RigConfig rig = loadRig(resourceFolder() / "rigs" / "paper.toml");
  rig.simulation.images = true;
  std::vector<Block> headless, window;
  for (int i = 0; i < options.blocks; ++i) {
    headless.push_back(measure(rig, options.block_s, false));
    window.push_back(measure(rig, options.block_s, true));
  }
  const double headless_p99 = medianOf(headless, &Block::server_p99_us);
  const double window_p99 = medianOf(window, &Block::server_p99_us);
  nlohmann::ordered_json report;
  report["blocks"] = options.blocks;
  report["block_s"] = options.block_s;
  report["server_us"] = {{"headless", summary(headless)}, {"window", summary(window)}};
  report["window_over_headless_p99"] = window_p99 / headless_p99;
  report["window_minus_headless_p99_us"] = window_p99 - headless_p99;
  report["gui_hz"] = medianOf(window, &Block::gui_hz);
  report["picture_hz"] = medianOf(window, &Block::picture_hz);
  report["scene_hz"] = medianOf(window, &Block::scene_hz);
  report["sixteen_cameras"] = sixteenPanes(options.block_s);
  printBenchReport(report, options.json);
}

}  // namespace

void addPipelineBench(CLI::App& app) {
  auto options = std::make_shared<Options>();
  CLI::App* command =
      app.add_subcommand("pipeline", "What the window costs the flight, in alternating blocks");
  command->add_flag("--json", options->json, "Print one JSON object");
  command->add_option("--seconds", options->block_s, "Length of a block")->check(CLI::Range(2.0, 600.0));
  command->add_option("--blocks", options->blocks, "Blocks of each kind")->check(CLI::Range(1, 100));
  command->callback([options] { bench(*options); });
}

}  // namespace helical
