#include "app/bench_particles.h"

#include <CLI/CLI.hpp>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <opencv2/calib3d.hpp>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "app/bench_report.h"
#include "app/side_by_side.h"
#include "engine/base/random.h"
#include "engine/calibration/particle_filter.h"
#include "engine/geometry/rotation.h"

namespace helical {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kFrames = 60;
constexpr int kRounds = 15;
constexpr double kSigmaPx = 0.5;
constexpr double kFloor = 1e-3;
constexpr std::array<int, 2> kParticles{1000, 4000};

struct Frame {
  TimeNs exposure = 0;
  RigidTransform world_from_body;
  std::vector<LabelledPixel> pixels;
  std::vector<BearingTarget> targets;
};

/// A second of hovering before one camera with the paper's four markers.
struct Hover {
  CameraModel camera{640, 480, 567.6, 567.6, 319.5, 239.5, {-0.05, 0.01, 0.0004, -0.0003, 0.0}};
  MarkerLayout markers = MarkerLayout::paper();
  RigidTransform camera_from_world{expSO3({2.3, 0.0, 0.0}), {0.0, 0.2, 2.8}};
  std::vector<Frame> frames;

  Hover() {
    Random random(1);
    for (int k = 0; k < kFrames; ++k) frames.push_back(look(k, random));
  }

  Frame look(int k, Random& random) const {
    const double phase = 2.0 * kPi * k / kFrames;
    Frame frame;
    frame.exposure = fromSeconds(k / 60.0);
    frame.world_from_body = {expSO3({0.05 * std::sin(phase), 0.05 * std::cos(2.0 * phase), 0.1 * phase}),
                             {0.05 * std::cos(phase), 0.05 * std::sin(phase), 0.6}};
    for (int m = 0; m < markers.count(); ++m) {
      const Eigen::Vector3d in_world = frame.world_from_body * markers.inBody(markerId(m));
      const Eigen::Vector2d noise(random.normal(), random.normal());
      const Eigen::Vector2d pixel = camera.project(camera_from_world * in_world).value() + kSigmaPx * noise;
      frame.pixels.push_back({markerId(m), pixel, kSigmaPx * kSigmaPx * Eigen::Matrix2d::Identity()});
      frame.targets.push_back({in_world, camera.bearing(pixel),
                               camera.fx() / kSigmaPx * Eigen::Matrix2d::Identity(),
                               1.0 / (std::sqrt(2.0 * kPi) * kSigmaPx)});
    }
    return frame;
  }
};

/// What a filter is without its likelihood: weights, resampling, mean and covariance.
class BareFilter {
 public:
  BareFilter(const Hover& hover, int particles)
      : hover_(hover), cloud_(particles, 1), log_likelihoods_(static_cast<std::size_t>(particles)) {
    cloud_.seed(hover.camera_from_world, 1e-5 * Matrix6d::Identity());
  }

  template <typename Likelihood>
  void step(const Likelihood& likelihood) {
    likelihood(cloud_, hover_.frames[next_], log_likelihoods_);
    next_ = (next_ + 1) % hover_.frames.size();
    cloud_.reweigh(log_likelihoods_, 1.0);
    if (cloud_.effectiveSampleSize() < 0.5 * cloud_.count()) cloud_.resample(0.5);
    moments_ = cloud_.moments();
  }

 private:
  const Hover& hover_;
  ParticleCloud cloud_;
  std::vector<float> log_likelihoods_;
  std::size_t next_ = 0;
  CloudMoments moments_;
};

void helicalLikelihood(const ParticleCloud& cloud, const Frame& frame, std::span<float> result) {
  logLikelihoods(cloud, frame.targets, kFloor, LikelihoodProduct::kPerMarker, result);
}

/// Equation 11 with OpenCV's projection of all balls for one particle after the other.
class OpencvLikelihood {
 public:
  explicit OpencvLikelihood(const CameraModel& camera)
      : intrinsics_(camera.fx(), 0.0, camera.cx(), 0.0, camera.fy(), camera.cy(), 0.0, 0.0, 1.0) {
    for (const double k : {-0.05, 0.01, 0.0004, -0.0003, 0.0}) distortion_.push_back(k);
  }

  void operator()(ParticleCloud& cloud, const Frame& frame, std::span<float> result) const {
    std::vector<cv::Point3d> balls;
    for (const BearingTarget& target : frame.targets)
      balls.emplace_back(target.ball_in_world.x(), target.ball_in_world.y(), target.ball_in_world.z());
    std::vector<cv::Point2d> seen;
    const auto poses = cloud.poses();
    for (std::size_t i = 0; i < poses.size(); ++i) {
      const RigidTransform& pose = poses[i].camera_from_world;
      const Eigen::Vector3d turn = logSO3(pose.rotation);
      cv::projectPoints(balls, cv::Vec3d(turn.x(), turn.y(), turn.z()),
                        cv::Vec3d(pose.translation.x(), pose.translation.y(), pose.translation.z()),
                        intrinsics_, distortion_, seen);
      double product = 1.0;
      for (std::size_t m = 0; m < seen.size(); ++m) {
        const Eigen::Vector2d off(seen[m].x - frame.pixels[m].pixel.x(),
                                  seen[m].y - frame.pixels[m].pixel.y());
        product *=
            frame.targets[m].peak * std::exp(-0.5 * off.squaredNorm() / (kSigmaPx * kSigmaPx)) + kFloor;
      }
      result[i] = static_cast<float>(std::log(product));
    }
  }

 private:
  cv::Matx33d intrinsics_;
  std::vector<double> distortion_;
};

/// The whole calibrator, with its stored frames and its search for other modes.
class WholeFilter {
 public:
  WholeFilter(const Hover& hover, int particles)
      : hover_(hover),
        filter_(ParticleFilterKind::kStabilised, {.particles = particles}, {}, hover.camera, hover.markers,
                1) {
    filter_.restart(hover.camera_from_world);
    for (int k = 0; k < 5 * kFrames; ++k) step();
  }
  void step() {
    const Frame& frame = hover_.frames[next_];
    next_ = (next_ + 1) % hover_.frames.size();
    filter_.step({frame.exposure, frame.world_from_body, 1e-6 * Matrix6d::Identity(), frame.pixels});
  }

 private:
  const Hover& hover_;
  ParticleFilter filter_;
  std::size_t next_ = 0;
};

void run(bool as_json) {
  cv::setNumThreads(1);
  const Hover hover;
  const OpencvLikelihood opencv(hover.camera);
  SideBySide bench;
  std::vector<std::unique_ptr<BareFilter>> bare;
  std::vector<std::unique_ptr<WholeFilter>> whole;
  std::vector<std::unique_ptr<ParticleCloud>> clouds;
  std::vector<std::vector<float>> results;
  for (const int particles : kParticles) {
    const std::string of = " " + std::to_string(particles);
    for (int i = 0; i < 2; ++i) bare.push_back(std::make_unique<BareFilter>(hover, particles));
    BareFilter *ours = bare[bare.size() - 2].get(), *theirs = bare.back().get();
    whole.push_back(std::make_unique<WholeFilter>(hover, particles));
    clouds.push_back(std::make_unique<ParticleCloud>(particles, 1));
    clouds.back()->seed(hover.camera_from_world, 1e-5 * Matrix6d::Identity());
    results.emplace_back(static_cast<std::size_t>(particles));
    bench.add(
        "helical" + of, [ours] { ours->step(helicalLikelihood); }, {}, kFrames);
    bench.add(
        "projectpoints" + of, [theirs, &opencv] { theirs->step(opencv); }, {}, kFrames / 10);
    bench.add(
        "calibrator" + of, [filter = whole.back().get()] { filter->step(); }, {}, kFrames);
    bench.add(
        "likelihood" + of,
        [cloud = clouds.back().get(), result = std::span<float>(results.back()), &hover] {
          helicalLikelihood(*cloud, hover.frames.front(), result);
        },
        {}, kFrames);
  }
  bench.measure(kRounds);

  Json report;
  report["projectpoints_over_helical"] = bench.ratio("projectpoints 4000", "helical 4000");
  report["particle_markers_per_s"] = 1e6 * 4000 * hover.markers.count() / bench.medianUs("likelihood 4000");
  report["markers"] = hover.markers.count();
  for (const int particles : kParticles) {
    const std::string of = std::to_string(particles);
    for (const std::string name : {"calibrator", "helical", "projectpoints", "likelihood"})
      report["frame_us"][of][name] = bench.medianUs(name + " " + of);
  }
  printBenchReport(report, as_json);
}

}  // namespace

void addParticlesBench(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("particles", "The particle filter beside the same one through cv::projectPoints");
  auto as_json = std::make_shared<bool>(false);
  command->add_flag("--json", *as_json, "One JSON object on stdout");
  command->callback([as_json] { run(*as_json); });
}

}  // namespace helical
