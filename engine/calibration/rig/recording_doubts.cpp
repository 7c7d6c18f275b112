#include "engine/calibration/rig/recording_doubts.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "engine/calibration/rig/quantile.h"

namespace helical {
namespace {

constexpr double kLineSigmas = 8.0;    // of a pixel: what keeps within them of a line does not leave it
constexpr double kLeastSigmaPx = 0.3;  // a wrong solution may fit its few inliers better than noise does
constexpr double kMedianToSigma = 1.4826;
constexpr double kRestSigmas = 6.0;  // of a pixel
constexpr double kFarMedians = 3.0;  // beyond them a pixel is no part of the line, but a false one
constexpr int kLineRounds = 10;
constexpr std::size_t kFewestOfALine = 10;

constexpr std::size_t kFewestOfAPart = 30;  // sightings on each side of a move
constexpr double kMostlyRejected = 0.75, kOtherRejectedLess = 0.4;
constexpr double kSurelyMoved = 30.0;  // log-likelihood

/// How far most pixels of one camera keep from the straight line that fits them best [px]; infinite if most
/// do not.
double widthOfWay(std::vector<Eigen::Vector2d> pixels) {
  const std::size_t all = pixels.size();
  double width = 0.0;
  for (int round = 0; round < kLineRounds; ++round) {
    Eigen::Vector2d mean = Eigen::Vector2d::Zero();
    for (const auto& p : pixels) mean += p / static_cast<double>(pixels.size());
    Eigen::Matrix2d spread = Eigen::Matrix2d::Zero();
    for (const auto& p : pixels) spread += (p - mean) * (p - mean).transpose();
    const Eigen::Vector2d across =
        Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(spread).eigenvectors().col(0);
    std::vector<double> distances;
    for (const auto& p : pixels) distances.push_back(std::abs(across.dot(p - mean)));
    const double median = quantileOf(distances, 0.5);
    width = kMedianToSigma * median;
    std::erase_if(pixels,
                  [&](const auto& p) { return std::abs(across.dot(p - mean)) > kFarMedians * median; });
    if (2 * pixels.size() < all) return std::numeric_limits<double>::infinity();
  }
  return width;
}

struct Expected {
  double time_s;
  bool rejected;
};

/// A camera's sightings of what the other cameras place inside its image, in order of time: whether it saw it
/// there. Where the target is out of sight false sightings say nothing.
std::vector<Expected> expectedSightings(const RigSolution& s, std::size_t camera) {
  const bool body = s.table.kind == TargetKind::kBody;
  const std::ptrdiff_t fewest = body ? 4 : 2;
  const auto starts = itemStarts(s.table);
  std::vector<Expected> found;
  for (std::size_t i = 0; i + 1 < starts.size(); ++i) {
    const auto item = std::span(s.table.sightings).subspan(starts[i], starts[i + 1] - starts[i]);
    const auto others = std::count_if(item.begin(), item.end(), [&](const Sighting& k) {
      return k.inlier && static_cast<std::size_t>(k.camera) != camera;
    });
    if (others < fewest) continue;
    for (const Sighting& k : item) {
      if (static_cast<std::size_t>(k.camera) != camera || k.adrift) continue;
      const auto point = pointInWorld(s.state, s.table, k);
      const CameraModel& model = s.cameras[camera].model;
      const auto pixel = point ? model.project(*s.state.camera_from_world[camera] * *point) : std::nullopt;
      if (pixel && model.contains(*pixel)) found.push_back({s.table.item_time_s[i], !k.inlier});
    }
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const Expected& a, const Expected& b) { return a.time_s < b.time_s; });
  return found;
}

/// Log-likelihood of so many of so many under their own share.
double likelihood(double part, double all) {
  double sum = 0.0;
  for (const double k : {part, all - part})
    if (k > 0.0) sum += k * std::log(k / all);
  return sum;
}

}  // namespace

// By all sightings: what is an inlier depends on poses that many lines explain.
bool sawOnlyALine(const RigSolution& s) {
  if (s.table.kind == TargetKind::kBody) return false;
  std::vector<std::vector<Eigen::Vector2d>> pixels(s.cameras.size());
  for (const Sighting& k : s.table.sightings) {
    const CameraModel& model = s.cameras[static_cast<std::size_t>(k.camera)].model;
    auto& of_camera = pixels[static_cast<std::size_t>(k.camera)];
    const Eigen::Vector2d pixel(model.fx() * k.bearing.x(), model.fy() * k.bearing.y());
    // A target that rests is one place, however long.
    if (of_camera.empty() ||
        (pixel - of_camera.back()).norm() > kRestSigmas * std::max(kLeastSigmaPx, s.sigma_px))
      of_camera.push_back(pixel);
  }
  std::erase_if(pixels, [](const auto& of_camera) { return of_camera.size() < kFewestOfALine; });
  return !pixels.empty() && std::all_of(pixels.begin(), pixels.end(), [&](const auto& of_camera) {
    return widthOfWay(of_camera) < kLineSigmas * std::max(kLeastSigmaPx, s.sigma_px);
  });
}

std::optional<CameraMove> whenMoved(const RigSolution& s, std::size_t camera) {
  if (!s.state.camera_from_world[camera] || s.table.kind == TargetKind::kStillMarkers) return std::nullopt;
  const std::vector<Expected> all = expectedSightings(s, camera);
  const auto rejected_of_all = static_cast<double>(
      std::count_if(all.begin(), all.end(), [](const Expected& e) { return e.rejected; }));
  const auto count = static_cast<double>(all.size());
  std::optional<CameraMove> best;
  double most = kSurelyMoved, rejected = 0.0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const auto before = static_cast<double>(i);
    if (i >= kFewestOfAPart && i + kFewestOfAPart <= all.size()) {
      const double first = rejected / before, second = (rejected_of_all - rejected) / (count - before);
      const double gain = likelihood(rejected, before) +
                          likelihood(rejected_of_all - rejected, count - before) -
                          likelihood(rejected_of_all, count);
      if (gain > most && std::max(first, second) > kMostlyRejected &&
          std::abs(first - second) > kOtherRejectedLess) {
        most = gain;
        best = CameraMove{all[i].time_s, first < second};
      }
    }
    rejected += all[i].rejected ? 1.0 : 0.0;
  }
  return best;
}

}  // namespace helical
