#include "app/bench_centroids.h"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "engine/base/clock.h"
#include "engine/base/random.h"
#include "engine/markers/extractor.h"

namespace helical {
namespace {

constexpr int kRuns = 150;
constexpr int kBounds = 6;    ///< places in the pixel that the bound is averaged over
constexpr int kSamples = 12;  ///< of a pixel, each way

enum Unknown {
  kX,
  kY,
  kRadius,
  kLightX,
  kLightY,
  kLightZ,
  kEdge,
  kBall,
  kWall = kBall + 3,
  kHider = kWall + 3
};
constexpr int kUnknowns = kHider + 3;
using Unknowns = Eigen::Matrix<double, kUnknowns, 1>;

struct Case {
  double radius, noise, shading, hidden;
};

/// Where the edge of what hides a share of a disc lies, in radii from its centre.
double edgeHiding(double share) {
  double low = -1.0, high = 1.0;
  for (int i = 0; i < 50; ++i) {
    const double at = 0.5 * (low + high);
    const double beyond = (std::acos(at) - at * std::sqrt(1.0 - at * at)) / M_PI;
    (beyond > share ? low : high) = at;
  }
  return low;
}

Unknowns trueUnknowns(const Case& ball, double x, double y) {
  Unknowns u;
  // A ball whose colour is what the unshaded part of the light leaves of it.
  const double ambient = 1.0 - ball.shading, directed = ball.shading / std::max(ambient, 1e-9);
  u << x, y, ball.radius, -0.2 * directed, -0.4 * directed, 0.8 * directed,
      ball.hidden > 0.0 ? ball.radius * edgeHiding(ball.hidden) : 1e3, 60 * ambient, 200 * ambient,
      50 * ambient, 105, 110, 115, 40, 40, 40;
  return u;
}

class BallPainter {
 public:
  explicit BallPainter(const Case& ball)
      : side_(2 * static_cast<int>(std::ceil(ball.radius)) + 15), ball_(ball) {}

  int side() const { return side_; }
  double middle() const { return 0.5 * (side_ - 1); }

  /// Three channels of each pixel, one after the other.
  Eigen::VectorXd paint(const Unknowns& u) const {
    Eigen::VectorXd picture(3 * side_ * side_);
    for (int y = 0; y < side_; ++y)
      for (int x = 0; x < side_; ++x) picture.segment<3>(3 * (y * side_ + x)) = pixel(u, x, y);
    return picture;
  }

 private:
  Eigen::Vector3d pixel(const Unknowns& u, int x, int y) const {
    const double distance = std::hypot(x - u[kX], y - u[kY]);
    if (distance > u[kRadius] + 1.5 && std::abs(x - u[kX] - u[kEdge]) > 1.0)
      return x > u[kX] + u[kEdge] ? u.segment<3>(kHider) : u.segment<3>(kWall);
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (int j = 0; j < kSamples; ++j)
      for (int i = 0; i < kSamples; ++i)
        sum += sample(u, x - 0.5 + (i + 0.5) / kSamples, y - 0.5 + (j + 0.5) / kSamples);
    return sum / (kSamples * kSamples);
  }

  /// Edges are smooth over a sample, so that derivatives by differences exist.
  Eigen::Vector3d sample(const Unknowns& u, double x, double y) const {
    const double dx = (x - u[kX]) / u[kRadius], dy = (y - u[kY]) / u[kRadius], d2 = dx * dx + dy * dy;
    const double inside = step(u[kRadius] * (1.0 - std::sqrt(d2))), hidden = step(x - u[kX] - u[kEdge]);
    double light = u[kLightX] * dx + u[kLightY] * dy + u[kLightZ] * std::sqrt(std::max(0.0, 1.0 - d2));
    if (ball_.shading > 0.0) light = std::max(0.0, light);
    const Eigen::Vector3d shown =
        inside * (1.0 + light) * u.segment<3>(kBall) + (1.0 - inside) * u.segment<3>(kWall);
    return (1.0 - hidden) * shown + hidden * u.segment<3>(kHider);
  }

  static double step(double x) { return std::clamp(0.5 + kSamples * x, 0.0, 1.0); }

  int side_;
  Case ball_;
};

/// Root mean square per axis that no unbiased estimator goes below.
double bound(const Case& ball, const BallPainter& painter, Random& random) {
  double squares = 0.0;
  for (int place = 0; place < kBounds; ++place) {
    const Unknowns truth = trueUnknowns(ball, painter.middle() + random.uniform(-0.5, 0.5),
                                        painter.middle() + random.uniform(-0.5, 0.5));
    Eigen::MatrixXd slopes(3 * painter.side() * painter.side(), kUnknowns);
    for (int k = 0; k < kUnknowns; ++k) {
      const double h = k < kLightX ? 0.02 : 1e-3 + 0.01 * std::abs(truth[k]);
      Unknowns more = truth, less = truth;
      more[k] += k == kEdge ? 0.02 : h;
      less[k] -= k == kEdge ? 0.02 : h;
      slopes.col(k) = (painter.paint(more) - painter.paint(less)) / (more[k] - less[k]);
    }
    Eigen::MatrixXd information = slopes.transpose() * slopes / (ball.noise * ball.noise);
    information.diagonal().array() += 1e-12;  // what hides nothing is not seen
    const Eigen::MatrixXd inverse = information.ldlt().solve(Eigen::MatrixXd::Identity(kUnknowns, kUnknowns));
    squares += 0.5 * (inverse(kX, kX) + inverse(kY, kY)) / kBounds;
  }
  return std::sqrt(squares);
}

struct Errors {
  double squares = 0.0;
  double nees = 0.0;  ///< per axis
  int found = 0;
  double time_us = 0.0;
  double rms() const { return std::sqrt(squares / std::max(1, found)); }
};

Errors measure(const Case& ball, const BallPainter& painter, CentroidEstimator estimator, Random random) {
  MarkerOptions options;
  options.estimator = estimator;
  Extractor extractor(options);
  extractor.disableBackground();
  Errors errors;
  const int side = painter.side();
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(3 * side * side));
  Observation found;
  extractor.extract({bytes.data(), side, side, 3 * side, PixelFormat::kBgr8}, found);  // prepares its tables
  for (int run = 0; run < kRuns; ++run) {
    const Eigen::Vector2d truth(painter.middle() + random.uniform(-0.5, 0.5),
                                painter.middle() + random.uniform(-0.5, 0.5));
    const Eigen::VectorXd picture = painter.paint(trueUnknowns(ball, truth.x(), truth.y()));
    for (std::size_t i = 0; i < bytes.size(); ++i)
      bytes[i] = static_cast<std::uint8_t>(std::clamp(
          std::lround(picture[static_cast<Eigen::Index>(i)] + ball.noise * random.normal()), 0L, 255L));
    const TimeNs start = threadCpuTime();
    extractor.extract({bytes.data(), side, side, 3 * side, PixelFormat::kBgr8}, found);
    const TimeNs taken = threadCpuTime() - start;
    if (found.count == 0) continue;
    const Eigen::Vector2d error = found.centroids[0].pixel - truth;
    errors.squares += 0.5 * error.squaredNorm();
    errors.nees += 0.5 * error.dot(found.centroids[0].covariance.ldlt().solve(error));
    errors.time_us += 1e-3 * static_cast<double>(taken) / kRuns;
    ++errors.found;
  }
  return errors;
}

}  // namespace

nlohmann::ordered_json benchCentroids() {
  nlohmann::ordered_json table = nlohmann::ordered_json::array();
  Random random(1);
  for (const double radius : {3.0, 5.0, 8.0})
    for (const double noise : {2.0, 5.0})
      for (const double shading : {0.0, 0.5})
        for (const double hidden : {0.0, 0.25}) {
          const Case ball{radius, noise, shading, hidden};
          const BallPainter painter(ball);
          const double least = bound(ball, painter, random);
          const Errors disc = measure(ball, painter, CentroidEstimator::kDisc, random);
          const Errors binary = measure(ball, painter, CentroidEstimator::kBinary, random);
          table.push_back({{"radius_px", radius},
                           {"noise", noise},
                           {"shading", shading},
                           {"hidden", hidden},
                           {"crb_px", least},
                           {"rms_px", disc.rms()},
                           {"rms_over_crb", disc.rms() / least},
                           {"nees", disc.nees / std::max(1, disc.found)},
                           {"binary_rms_px", binary.rms()},
                           {"found", static_cast<double>(disc.found) / kRuns},
                           {"time_us", disc.time_us}});
        }
  return table;
}

}  // namespace helical
