#include "engine/calibration/rig/rig_calibration.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <set>

#include "engine/base/error.h"
#include "engine/calibration/rig/camera_delays.h"
#include "engine/calibration/rig/chain_bodies.h"
#include "engine/calibration/rig/chain_points.h"
#include "engine/calibration/rig/free_body.h"
#include "engine/calibration/rig/point_structure.h"
#include "engine/calibration/rig/rig_bundle.h"
#include "engine/calibration/rig/rig_covariance.h"
#include "engine/calibration/rig/rig_frame.h"
#include "engine/calibration/rig/rig_state.h"
#include "engine/calibration/rig/rig_verdict.h"
#include "engine/geometry/rotation.h"

namespace helical {
namespace {

constexpr double kRoughTolerance = 0.006;  // of the image's width, in which a first pose has to agree
constexpr double kGateSigmas = 6.0;
// Detectors' errors have longer tails than Gauss'. Where next to nothing lies beyond the wide gate, what lies
// between the two is such a tail and part of the recording; else it is the near end of gross outliers.
constexpr double kWideGateSigmas = 30.0;
constexpr double kFewBeyond = 0.01;  // of the sightings
constexpr double kRobustSigmas = 3.0;
constexpr double kTightestGatePx = 0.5;
constexpr int kGateRounds = 4;
constexpr int kDelayRounds = 12, kDelayIterations = 15;
constexpr double kSettledPeriods = 1e-3;  // a delay that changes by less has settled
// Interpolation averages neighbours, which makes pixels look better than they are.
constexpr double kInterpolationFlatters = 1.2;

struct Solution {
  std::vector<RigCamera> cameras;
  SightingTable table;
  std::optional<FreeBody> body;  // if it is solved for
  RigState state;
  double sigma_px = 0.0;
  double explained = 0.0;  // share of sightings
};

int fewestInliers(const SightingTable& table) {
  return table.kind == TargetKind::kBody ? 3 : 2;
}

double roughTolerance(std::span<const RigCamera> cameras) {
  double widest = 0.0;
  for (const RigCamera& c : cameras) widest = std::max(widest, static_cast<double>(c.model.width()));
  return std::max(2.0, kRoughTolerance * widest);
}

/// Share of the sightings that could agree with another camera's, and do not.
double rejectedShare(const Solution& s) {
  const auto starts = itemStarts(s.table);
  long possible = 0, rejected = 0;
  for (std::size_t i = 0; i + 1 < starts.size(); ++i) {
    const auto item = std::span(s.table.sightings).subspan(starts[i], starts[i + 1] - starts[i]);
    std::set<std::int32_t> placed;
    for (const Sighting& k : item)
      if (s.state.camera_from_world[static_cast<std::size_t>(k.camera)]) placed.insert(k.camera);
    if (placed.size() < 2) continue;
    for (const Sighting& k : item) {
      if (!placed.contains(k.camera)) continue;
      ++possible;
      rejected += k.inlier ? 0 : 1;
    }
  }
  return possible > 0 ? static_cast<double>(rejected) / static_cast<double>(possible) : 1.0;
}

void gate(Solution& s, std::span<const RigCamera> cameras, double tolerance_px) {
  const double tolerance = std::clamp(tolerance_px, kTightestGatePx, 3.0 * roughTolerance(cameras));
  if (s.table.kind == TargetKind::kBody)
    gateSightings(s.state, cameras, s.table, tolerance, fewestInliers(s.table));
  else
    placePoints(s.state, cameras, s.table, tolerance);
  for (Sighting& k : s.table.sightings) k.inlier = k.inlier && !k.adrift;
}

/// Gate and bundle in turn until both have settled; plain least squares at the end.
void refine(Solution& s) {
  for (int round = 0; round < kGateRounds; ++round) {
    const double sigma = sightingSigma(s.state, s.cameras, s.table);
    gate(s, s.cameras, kWideGateSigmas * sigma);
    if (rejectedShare(s) > kFewBeyond) gate(s, s.cameras, kGateSigmas * sigma);
    const bool last = round + 1 == kGateRounds;
    BundleOptions options;
    options.robust_scale_px = last ? 0.0 : kRobustSigmas * sigma;
    if (s.body) {
      s.body->sigma_px = sigma;
      options.free_body = &*s.body;
    }
    adjustBundle(s.state, s.body ? s.body->given_cameras : s.cameras, s.table, options);
    if (s.body) takeOver(*s.body, s.table, s.cameras);
  }
  s.sigma_px = sightingSigma(s.state, s.cameras, s.table);
  const auto inliers = std::count_if(s.table.sightings.begin(), s.table.sightings.end(),
                                     [](const auto& k) { return k.inlier; });
  s.explained =
      static_cast<double>(inliers) / static_cast<double>(std::max<std::size_t>(1, s.table.sightings.size()));
}

/// Residuals [px, per axis of one without delay] of the sightings that are inliers in both.
std::pair<std::vector<Eigen::Vector2d>, std::vector<Eigen::Vector2d>> commonResiduals(
    const Solution& without, const Solution& with, std::span<const RigCamera> cameras) {
  std::pair<std::vector<Eigen::Vector2d>, std::vector<Eigen::Vector2d>> both;
  for (std::size_t i = 0; i < with.table.sightings.size(); ++i) {
    const Sighting &a = without.table.sightings[i], &b = with.table.sightings[i];
    if (!a.inlier || !b.inlier) continue;
    const auto of_a = sightingResidual(without.state, cameras, without.table, a);
    const auto of_b = sightingResidual(with.state, cameras, with.table, b);
    if (!of_a || !of_b) continue;
    const double periods = with.table.late_s[static_cast<std::size_t>(b.camera)] / with.table.period_s;
    both.first.push_back(*of_a);
    both.second.push_back(*of_b / std::sqrt(noiseAfterDelay(with.table.timing, periods).variance));
  }
  return both;
}

/// Less is likelier: residuals are smaller, and as much is explained.
double unlikeliness(const Solution& s) {
  return s.sigma_px / std::max(1e-3, s.explained * s.explained);
}

/// Delays and poses in turn, until the delays have settled. `knowing_noise`: once residuals are noise, what a
/// delay gains by averaging it is known, and taken back.
void settleDelays(Solution& s, std::span<const RigCamera> cameras, bool knowing_noise) {
  for (int round = 0; round < kDelayRounds; ++round) {
    const double sigma = sightingSigma(s.state, cameras, s.table);
    gate(s, cameras, kWideGateSigmas * sigma);
    std::vector<double> later_s(cameras.size(), 0.0);
    BundleOptions options;
    options.robust_scale_px = kRobustSigmas * sigma;
    options.max_iterations = kDelayIterations;
    options.late_s = &later_s;
    options.sigma_px = sigma;
    options.take_back_averaging = knowing_noise;
    adjustBundle(s.state, cameras, s.table, options);
    takeOffDelays(s.table, cameras, later_s);
    const bool settled = std::all_of(later_s.begin(), later_s.end(), [&](double later) {
      return std::abs(later) < kSettledPeriods * s.table.period_s;
    });
    if (settled) return;
  }
}

/// Finds how much later than the first each camera saw, and keeps it if it explains the recording better.
void findDelays(Solution& s, std::span<const RigCamera> cameras) {
  if (s.table.kind == TargetKind::kStillMarkers || s.state.solvedCameras() < 2) return;
  if (!(s.table.period_s > 0.0)) return;  // one instant
  Solution timed = s;
  timed.table.late_s.assign(cameras.size(), 0.0);
  settleDelays(timed, cameras, false);
  settleDelays(timed, cameras, true);
  giveUpAdrift(timed.table);
  refine(timed);
  const auto [without, with] = commonResiduals(s, timed, cameras);
  if (unlikeliness(timed) < unlikeliness(s) &&
      delaysAreReal(without, with, freeShare(timed.table), cameras.size()))
    s = std::move(timed);
}

Solution solveFreely(SightingTable table, std::span<const RigCamera> cameras,
                     const RigCalibrationOptions& options, const ProgressCallback& progress) {
  Solution s;
  s.cameras.assign(cameras.begin(), cameras.end());
  s.table = std::move(table);
  const double tolerance = roughTolerance(cameras);
  s.state = s.table.kind == TargetKind::kBody ? chainBodies(cameras, s.table, tolerance, progress)
                                              : chainPoints(cameras, s.table, tolerance, progress);
  refine(s);
  if (!options.trust_stamps) findDelays(s, cameras);
  return s;
}

/// The likelier timing: the one whose residuals are smaller, if it explains about as much.
Solution solveLikeliest(std::vector<SightingTable> tables, std::span<const RigCamera> cameras,
                        const RigCalibrationOptions& options, const ProgressCallback& progress) {
  std::optional<Solution> best;
  double least = 0.0;
  for (SightingTable& table : tables) {
    Solution s = solveFreely(std::move(table), cameras, options, progress);
    const double flatters = s.table.timing == Timing::kInterpolated ? kInterpolationFlatters : 1.0;
    const double score = s.state.solvedCameras() < 2 ? 1e300 : flatters * unlikeliness(s);
    if (best && score >= least) continue;
    least = score;
    best = std::move(s);
  }
  return std::move(*best);
}

double medianDistance(const Solution& s, std::size_t camera) {
  std::vector<double> distances;
  for (const Sighting& k : s.table.sightings)
    if (k.inlier && static_cast<std::size_t>(k.camera) == camera)
      distances.push_back((*s.state.camera_from_world[camera] * *pointInWorld(s.state, s.table, k)).norm());
  if (distances.empty()) return 0.0;
  const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
  std::nth_element(distances.begin(), middle, distances.end());
  return *middle;
}

CalibratedCamera reportCamera(const Solution& s, std::span<const RigCamera> cameras, std::size_t index,
                              const std::optional<Matrix6d>& covariance) {
  CalibratedCamera c;
  c.label = cameras[index].label;
  c.given = cameras[index].camera_from_world.has_value();
  c.camera_from_world = s.state.camera_from_world[index];
  c.rejected = s.table.ambiguous[index];
  c.observations = c.rejected;
  double squares = 0.0;
  std::set<int> parts;
  for (const Sighting& k : s.table.sightings) {
    if (static_cast<std::size_t>(k.camera) != index) continue;
    ++c.observations;
    const auto r = k.inlier ? sightingResidual(s.state, cameras, s.table, k) : std::nullopt;
    if (!r) {
      ++c.rejected;
      continue;
    }
    squares += r->squaredNorm();
    const auto part = [](double at, int size) { return std::clamp(static_cast<int>(4.0 * at / size), 0, 3); };
    parts.insert(4 * part(k.pixel.y(), cameras[index].model.height()) +
                 part(k.pixel.x(), cameras[index].model.width()));
  }
  const long inliers = c.observations - c.rejected;
  c.reprojection_rms_px = inliers > 0 ? std::sqrt(squares / static_cast<double>(inliers)) : 0.0;
  c.image_parts = static_cast<int>(parts.size());
  if (c.camera_from_world) c.distance_m = medianDistance(s, index);
  if (!s.table.late_s.empty()) {
    c.late_s = s.table.late_s[index];
    c.beyond_reach = std::abs(c.late_s) > 0.99 * kDelayReachPeriods * s.table.period_s;
  }
  c.covariance = covariance;
  if (covariance) {
    const auto largest = [](const Eigen::Matrix3d& block) {
      return std::sqrt(std::max(0.0, Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(block).eigenvalues()[2]));
    };
    c.orientation_sigma_deg = toDegrees(largest(covariance->topLeftCorner<3, 3>()));
    c.position_sigma_m = largest(covariance->bottomRightCorner<3, 3>());
  }
  return c;
}

void reportBody(const FreeBody& body, const RigCovariance& covariance, RigCalibration& result) {
  result.self = body.sigmas;
  const bool known = !covariance.focal_sigmas.empty();
  for (std::size_t c = 0; c < result.cameras.size(); ++c) {
    result.cameras[c].focal_scale = body.focal_scales[c];
    if (known) result.cameras[c].focal_sigma = covariance.focal_sigmas[c];
  }
  if (!(body.sigmas.marker_sigma_m > 0.0)) return;
  for (std::size_t i = 0; i < body.points.size(); ++i)
    result.points.push_back({body.given[i], body.points[i], known ? covariance.point_sigmas_m[i] : 0.0});
}

/// Without a measured scale: the first solved camera and the one farthest from it, whose distance is the
/// unit.
std::optional<KnownDistance> unitDistance(const RigState& state) {
  std::optional<KnownDistance> found;
  std::optional<std::size_t> first;
  for (std::size_t c = 0; c < state.camera_from_world.size(); ++c) {
    if (!state.camera_from_world[c]) continue;
    if (!first) first = c;
    const double d = (state.camera_from_world[c]->inverseTranslation() -
                      state.camera_from_world[*first]->inverseTranslation())
                         .norm();
    if (d > (found ? found->metres : 1e-12)) found = {*first, c, d};
  }
  return found;
}

std::size_t givenCount(std::span<const RigCamera> cameras) {
  return static_cast<std::size_t>(std::count_if(
      cameras.begin(), cameras.end(), [](const auto& c) { return c.camera_from_world.has_value(); }));
}

void refuseContradictions(std::span<const RigCamera> cameras, const PointRows& rows, const std::string& file,
                          const RigCalibrationOptions& options) {
  if (options.self.any() && rows.in_body.empty())
    throw Error(ErrorKind::kInput, "without body coordinates neither points nor focal lengths can be refined",
                file,
                "give columns body_x_m, body_y_m and body_z_m, or leave out --refine-markers and "
                "--refine-focal");
  if (!options.scale) return;
  if (!rows.in_body.empty())
    throw Error(ErrorKind::kInput, "the body coordinates set the scale already", "--scale",
                "leave --scale out");
  if (givenCount(cameras) > 1)
    throw Error(ErrorKind::kInput, "the given camera poses set the scale already", "--scale",
                "leave --scale out, or remove [camera.pose] from the rig");
}

}  // namespace

RigCalibration calibrateRig(std::span<const RigCamera> cameras, PointRows rows, const std::string& file,
                            const RigCalibrationOptions& options, const ProgressCallback& progress) {
  refuseContradictions(cameras, rows, file, options);
  const std::size_t given = givenCount(cameras);
  Solution s = solveLikeliest(bringTogether(std::move(rows), cameras, file), cameras, options, progress);
  const bool body = s.table.kind == TargetKind::kBody;
  RigCalibration result;
  result.metric = body || given > 1 || options.scale;
  result.scale_from = body            ? "body coordinates"
                      : given > 1     ? "given camera poses"
                      : options.scale ? "the given distance of two cameras"
                                      : "nothing: lengths are in arbitrary units";
  // Before the given poses are looked at: a wrong focal length is not to be laid at their door.
  if (options.self.any()) {
    s.body = freeBody(s.table, cameras, options.self, file);
    refine(s);
  }
  const GivenPoseError off = alignToGiven(s.state, cameras, body, options.scale);
  if (given > 0) {
    fixGiven(s.state, cameras);
    refine(s);
  }
  if (options.scale) alignToGiven(s.state, cameras, false, options.scale);
  result.world =
      given > 0 ? "that of the given camera poses" : "the frame of the first camera that could be placed";
  result.target = s.table.kind;
  result.timing = s.table.timing;
  result.items = s.table.items;
  result.thinned_by = s.table.thinned_by;
  result.unmatched = s.table.unmatched;
  result.delays = !s.table.late_s.empty();
  const bool scale_is_measured = body || given > 1;
  const RigCovariance covariance =
      rigCovariance(s.state, s.cameras, s.table,
                    scale_is_measured ? std::nullopt
                    : options.scale && s.state.camera_from_world[options.scale->a] &&
                            s.state.camera_from_world[options.scale->b]
                        ? options.scale
                        : unitDistance(s.state),
                    s.body ? &*s.body : nullptr);
  result.sigma_px = covariance.sigma_px;
  double farthest = 0.0;
  for (std::size_t c = 0; c < cameras.size(); ++c) {
    result.cameras.push_back(reportCamera(s, s.cameras, c, covariance.cameras[c]));
    farthest = std::max(farthest, result.cameras.back().distance_m);
  }
  if (s.body) reportBody(*s.body, covariance, result);
  result.given_off_deg = off.degrees;
  result.given_off_share = farthest > 0.0 ? off.metres / farthest : 0.0;
  judge(result, cameras);
  return result;
}

}  // namespace helical
