#include "app/bench_markers.h"

#include <hwy/cache_control.h>

#include <CLI/CLI.hpp>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <opencv2/imgproc.hpp>
#include <span>
#include <string>
#include <vector>

#include "app/bench_centroids.h"
#include "app/bench_read.h"
#include "app/bench_report.h"
#include "app/bench_scene.h"
#include "app/opencv_pipeline.h"
#include "app/side_by_side.h"
#include "engine/markers/cell_kernels.h"
#include "engine/markers/extractor.h"

namespace helical {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kRounds = 41;
constexpr std::size_t kLargerThanCaches = std::size_t{96} << 20;

void flush(const cv::Mat& image) {
  for (std::size_t i = 0; i < image.total() * image.elemSize(); i += 64) hwy::FlushCacheline(image.data + i);
}

ImageView viewOf(const cv::Mat& image, PixelFormat format) {
  return {image.data, image.cols, image.rows, static_cast<int>(image.step), format};
}

/// The red, green, green, blue of a sensor with a mosaic.
cv::Mat mosaicOf(const cv::Mat& bgr) {
  cv::Mat raw(bgr.size(), CV_8UC1);
  for (int y = 0; y < bgr.rows; ++y)
    for (int x = 0; x < bgr.cols; ++x)
      raw.at<std::uint8_t>(y, x) = bgr.at<cv::Vec3b>(y, x)[x % 2 != y % 2 ? 1 : x % 2 == 0 ? 2 : 0];
  return raw;
}

MarkerOptions binaryOptions() {
  MarkerOptions options;
  options.estimator = CentroidEstimator::kBinary;
  options.background_rows = 0;
  return options;
}

/// Openings and closings by 3 x 3 quads: what BGR images have by pixels. By default Bayer images have neither.
MarkerOptions quadOpeningOptions() {
  MarkerOptions options = binaryOptions();
  options.opening_px = options.closing_px = 5;
  return options;
}

/// One picture size: every way to extract its markers, with warm, flushed and displaced caches.
class SizeBench {
 public:
  SizeBench(int width, int height)
      : name_(std::to_string(width) + "x" + std::to_string(height)),
        scene_(renderBenchScene(width, height)),
        raw_(mosaicOf(scene_.frame)),
        raw_background_(mosaicOf(scene_.background)),
        all_green_(scene_.frame.size(), CV_8UC3, cv::Scalar(50, 192, 54)),
        displacing_(kLargerThanCaches, 1),
        components_(binaryOptions(), OpencvPipeline::Labelling::kConnectedComponents),
        contours_(binaryOptions(), OpencvPipeline::Labelling::kContours),
        binary_(binaryOptions()),
        fitted_(MarkerOptions{}),
        expecting_(MarkerOptions{}),
        bayer_(binaryOptions()),
        bayer_opened_(quadOpeningOptions()) {
    binary_.setBackground(viewOf(scene_.background, PixelFormat::kBgr8));
    for (Extractor* extractor : {&fitted_, &expecting_}) {
      extractor->setBackground(viewOf(scene_.background, PixelFormat::kBgr8));
      extractor->setIgnoredAreas({{{0.0, 0.0}, {0.2 * width, 0.0}, {0.1 * width, 0.3 * height}}});
    }
    for (Extractor* extractor : {&bayer_, &bayer_opened_})
      extractor->setBackground(viewOf(raw_background_, PixelFormat::kBayerRg8));
  }

  void measure() {
    add("opencv", [this] { components_.run(scene_.frame, scene_.background); });
    add("findcontours", [this] { contours_.run(scene_.frame, scene_.background); });
    add("helical", [this] { binary_.extract(viewOf(scene_.frame, PixelFormat::kBgr8), found_); });
    add("helical_default", [this] { fitted_.extract(viewOf(scene_.frame, PixelFormat::kBgr8), found_); });
    add("helical_expecting", [this] { expecting_.extract(viewOf(scene_.frame, PixelFormat::kBgr8), found_); });
    add("bayer", [this] { bayer_.extract(viewOf(raw_, PixelFormat::kBayerRg8), found_); });
    add("bayer_opened", [this] { bayer_opened_.extract(viewOf(raw_, PixelFormat::kBayerRg8), found_); });
    add("all_green", [this] { binary_.extract(viewOf(all_green_, PixelFormat::kBgr8), found_); });
    add("read", [this] { sum_ = sumOfBytes(scene_.frame.data, scene_.frame.total() * 3); });
    bench_.measure(kRounds);
  }

  void report(Json& report) const {
    for (const std::string state : {"cold", "warm", "displaced"}) {
      const auto set = [&](const char* key, const std::string& slow, const std::string& fast) {
        report[key][name_][state] = bench_.ratio(slow + " " + state, fast + " " + state);
      };
      set("opencv_over_helical", "opencv", "helical");
      set("findcontours_over_helical", "findcontours", "helical");
      set("helical_over_read", "helical", "read");
      set("opencv_over_helical_default", "opencv", "helical_default");
      set("findcontours_over_helical_default", "findcontours", "helical_default");
      set("helical_default_over_read", "helical_default", "read");
      set("helical_expecting_over_read", "helical_expecting", "read");
      set("bayer_over_bgr", "bayer_opened", "helical");
      set("bayer_unopened_over_bgr", "bayer", "helical");
      set("all_green_over_normal", "all_green", "helical");
      for (const std::string& way : ways_)
        report["times_us"][way][name_][state] = bench_.medianUs(way + " " + state);
    }
    report["markers_found"][name_] = marker_count_;
  }

  void countMarkers() {
    binary_.extract(viewOf(scene_.frame, PixelFormat::kBgr8), found_);
    marker_count_ = found_.count;
    BallPredictions predictions;
    for (const Centroid& centroid : std::span(found_.centroids.data(), static_cast<std::size_t>(found_.count))) {
      PredictedBall& ball = predictions.balls[static_cast<std::size_t>(predictions.count++)];
      ball.pixel = centroid.pixel;
      ball.radius_px = centroid.radius_px;
      ball.reach_px = 8.0;
      ball.whole = true;
    }
    expecting_.expect(predictions);
  }

 private:
  void add(const std::string& way, const std::function<void()>& run) {
    ways_.push_back(way);
    bench_.add(way + " warm", run, run);
    bench_.add(way + " cold", run, [this, run] {
      run();
      for (const cv::Mat* image : {&scene_.frame, &scene_.background, &raw_, &raw_background_, &all_green_})
        flush(*image);
    });
    bench_.add(way + " displaced", run,
               [this] { sum_ = sumOfBytes(displacing_.data(), displacing_.size()); });
  }

  std::string name_;
  BenchScene scene_;
  cv::Mat raw_, raw_background_, all_green_;
  std::vector<std::uint8_t> displacing_;
  OpencvPipeline components_, contours_;
  Extractor binary_;     ///< pixels to binary centroids
  Extractor fitted_;     ///< as it comes: discs, a background that follows the light, and an ignored area
  Extractor expecting_;  ///< the same, told where the balls should be
  Extractor bayer_;
  Extractor bayer_opened_;  ///< opened and closed by 3 x 3 cells, as BGR images are
  Observation found_;
  volatile std::uint64_t sum_ = 0;
  int marker_count_ = 0;
  std::vector<std::string> ways_;
  SideBySide bench_;
};

void run(bool as_json, const std::string& instructions) {
  cv::setNumThreads(1);
  useInstructionSet(instructions);
  Json report;
  report["instruction_set"] = instructionSet();
  for (const auto& [width, height] : {std::pair{640, 480}, {1920, 1080}}) {
    SizeBench bench(width, height);
    bench.countMarkers();
    bench.measure();
    bench.report(report);
  }
  report["centroids"] = benchCentroids();
  printBenchReport(report, as_json);
}

}  // namespace

void addMarkersBench(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "markers", "The extractor beside OpenCV and one read of the frame; its centroids beside their bound");
  auto as_json = std::make_shared<bool>(false);
  auto instructions = std::make_shared<std::string>();
  command->add_flag("--json", *as_json, "One JSON object on stdout");
  command->add_option("--instructions", *instructions, "Instruction set to use instead of the machine's best")
      ->check(CLI::IsMember(instructionSets()));
  command->callback([=] { run(*as_json, *instructions); });
}

}  // namespace helical
