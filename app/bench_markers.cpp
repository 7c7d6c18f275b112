#include "app/bench_markers.h"

#include <hwy/cache_control.h>
#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "app/bench_report.h"
#include "app/bench_scene.h"
#include "app/opencv_pipeline.h"
#include "app/side_by_side.h"
#include "engine/markers/extractor.h"

namespace helical {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kRounds = 41;

void flush(const cv::Mat& image) {
  for (std::size_t i = 0; i < image.total() * image.elemSize(); i += 64) hwy::FlushCacheline(image.data + i);
}

std::uint64_t sumOfWords(const cv::Mat& image) {
  const auto* words = reinterpret_cast<const std::uint64_t*>(image.data);
  std::uint64_t sum = 0;
  for (std::size_t i = 0; i < image.total() * image.elemSize() / sizeof(std::uint64_t); ++i) sum += words[i];
  return sum;
}

ImageView viewOf(const cv::Mat& bgr) {
  return {bgr.data, bgr.cols, bgr.rows, static_cast<int>(bgr.step), PixelFormat::kBgr8};
}

void addSize(int width, int height, Json& report) {
  const BenchScene scene = renderBenchScene(width, height);
  const MarkerOptions options;
  Extractor extractor(options);
  extractor.setBackground(viewOf(scene.background));
  OpencvPipeline components(options, OpencvPipeline::Labelling::kConnectedComponents);
  OpencvPipeline contours(options, OpencvPipeline::Labelling::kContours);
  Observation found;
  volatile std::uint64_t sink = 0;

  const std::string size = std::to_string(width) + "x" + std::to_string(height);
  const auto make_cold = [&scene] { flush(scene.frame), flush(scene.background); };
  SideBySide bench;
  const auto add = [&](const std::string& name, const std::function<void()>& run) {
    bench.add(name + " warm", run, run);
    bench.add(name + " cold", run, make_cold);
  };
  add("opencv", [&] { components.run(scene.frame, scene.background); });
  add("findcontours", [&] { contours.run(scene.frame, scene.background); });
  add("helical", [&] { extractor.extract(viewOf(scene.frame), found); });
  add("read", [&] { sink = sumOfWords(scene.frame); });
  bench.measure(kRounds);

  for (const std::string state : {"cold", "warm"}) {
    const auto ratio = [&](const std::string& slow, const std::string& fast) {
      return bench.ratio(slow + " " + state, fast + " " + state);
    };
    report["opencv_over_helical"][size][state] = ratio("opencv", "helical");
    report["findcontours_over_helical"][size][state] = ratio("findcontours", "helical");
    report["helical_over_read"][size][state] = ratio("helical", "read");
    for (const std::string name : {"opencv", "findcontours", "helical", "read"})
      report["times_us"][name][size][state] = bench.medianUs(name + " " + state);
  }
  report["regions"][size] = found.count;
}

void run(bool as_json) {
  cv::setNumThreads(1);
  Json report;
  addSize(640, 480, report);
  addSize(1920, 1080, report);
  printBenchReport(report, as_json);
}

}  // namespace

void addMarkersBench(CLI::App& app) {
  CLI::App* command = app.add_subcommand("markers", "The extractor beside OpenCV and one read of the frame");
  auto as_json = std::make_shared<bool>(false);
  command->add_flag("--json", *as_json, "One JSON object on stdout");
  command->callback([as_json] { run(*as_json); });
}

}  // namespace helical
