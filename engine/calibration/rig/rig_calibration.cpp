#include "engine/calibration/rig/rig_calibration.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <set>

#include "engine/base/error.h"
#include "engine/calibration/rig/camera_delays.h"
#include "engine/calibration/rig/free_body.h"
#include "engine/calibration/rig/quantile.h"
#include "engine/calibration/rig/recording_doubts.h"
#include "engine/calibration/rig/rig_covariance.h"
#include "engine/calibration/rig/rig_frame.h"
#include "engine/calibration/rig/rig_solution.h"
#include "engine/calibration/rig/rig_verdict.h"
#include "engine/geometry/rotation.h"

namespace helical {
namespace {

double medianDistance(const RigSolution& s, std::size_t camera) {
  std::vector<double> distances;
  for (const Sighting& k : s.table.sightings)
    if (k.inlier && static_cast<std::size_t>(k.camera) == camera)
      distances.push_back((*s.state.camera_from_world[camera] * *pointInWorld(s.state, s.table, k)).norm());
  return quantileOf(distances, 0.5);
}

CalibratedCamera reportCamera(const RigSolution& s, std::size_t index,
                              const std::optional<Matrix6d>& covariance) {
  CalibratedCamera c;
  c.label = s.cameras[index].label;
  c.given = s.cameras[index].camera_from_world.has_value();
  c.camera_from_world = s.state.camera_from_world[index];
  c.rejected = s.table.ambiguous[index];
  c.observations = c.rejected;
  double squares = 0.0;
  std::set<int> parts;
  for (const Sighting& k : s.table.sightings) {
    if (static_cast<std::size_t>(k.camera) != index) continue;
    ++c.observations;
    const auto r = k.inlier ? sightingResidual(s.state, s.cameras, s.table, k) : std::nullopt;
    if (!r) {
      ++c.rejected;
      continue;
    }
    squares += r->squaredNorm();
    const auto part = [](double at, int size) { return std::clamp(static_cast<int>(4.0 * at / size), 0, 3); };
    parts.insert(4 * part(k.pixel.y(), s.cameras[index].model.height()) +
                 part(k.pixel.x(), s.cameras[index].model.width()));
  }
  const long inliers = c.observations - c.rejected;
  c.reprojection_rms_px = inliers > 0 ? std::sqrt(squares / static_cast<double>(inliers)) : 0.0;
  c.image_parts = static_cast<int>(parts.size());
  if (c.camera_from_world) c.distance_m = medianDistance(s, index);
  if (!s.stamps_late_s.empty()) c.late_s = s.stamps_late_s[index];
  // Against its own stamps, not those of the items that its rows were put to.
  if (!s.table.late_s.empty()) *c.late_s += s.table.late_s[index] - s.table.stamps_after_s[index];
  c.beyond_reach = beyondDelayReach(s.table, index);
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

/// The first placed camera is the one whose stamps are taken for right.
void countDelaysFromFirst(RigCalibration& result) {
  const auto first = std::find_if(result.cameras.begin(), result.cameras.end(),
                                  [](const CalibratedCamera& c) { return c.camera_from_world.has_value(); });
  const double of_first = first == result.cameras.end() ? 0.0 : *first->late_s;
  for (CalibratedCamera& c : result.cameras)
    c.late_s = c.camera_from_world ? std::optional(*c.late_s - of_first) : std::nullopt;
}

void reportBody(const FreeBody& body, const RigCovariance& covariance, RigCalibration& result) {
  result.self = body.sigmas;
  const bool known = !covariance.focal_sigmas.empty();
  for (std::size_t c = 0; c < result.cameras.size(); ++c) {
    result.cameras[c].focal_scale = body.focal_scales[c];
    result.cameras[c].focal_sigma = known ? std::optional(covariance.focal_sigmas[c]) : std::nullopt;
  }
  if (!(body.sigmas.marker_sigma_m > 0.0)) return;
  for (std::size_t i = 0; i < body.points.size(); ++i)
    result.points.push_back(
        {body.given[i], body.points[i], known ? std::optional(covariance.point_sigmas_m[i]) : std::nullopt});
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

/// What the covariance takes for exact of lengths that are not measured.
std::optional<KnownDistance> heldDistance(const RigState& state, bool measured,
                                          const std::optional<KnownDistance>& scale) {
  if (measured) return std::nullopt;
  const bool known = scale && state.camera_from_world[scale->a] && state.camera_from_world[scale->b];
  return known ? scale : unitDistance(state);
}

void reportFocalDoubts(const RigSolution& s, const std::optional<KnownDistance>& scale_held,
                       RigCalibration& result) {
  const std::vector<FocalDoubt> doubts = doubtFocals(s.state, s.cameras, s.table, scale_held);
  for (std::size_t c = 0; c < doubts.size(); ++c) {
    CalibratedCamera& camera = result.cameras[c];
    camera.focal_off = doubts[c].off;
    camera.focal_off_sigma = doubts[c].sigma;
    if (camera.distance_m > 0.0)
      result.focal_share = std::max(result.focal_share, doubts[c].moves_by / camera.distance_m);
  }
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
  RigSolution s = solveLikeliest(std::move(rows), cameras, file, options, progress);
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
  result.delays = !s.table.late_s.empty() || !s.stamps_late_s.empty();
  result.along_a_line = sawOnlyALine(s);
  const auto scale_held = heldDistance(s.state, body || given > 1, options.scale);
  const RigCovariance covariance =
      rigCovariance(s.state, s.cameras, s.table, scale_held, s.body ? &*s.body : nullptr);
  result.sigma_px = covariance.sigma_px;
  const std::vector<double> near_misses = nearMisses(s);
  double farthest = 0.0;
  for (std::size_t c = 0; c < cameras.size(); ++c) {
    result.cameras.push_back(reportCamera(s, c, covariance.cameras[c]));
    result.cameras.back().near_misses = near_misses[c];
    result.cameras.back().moved = whenMoved(s, c);
    farthest = std::max(farthest, result.cameras.back().distance_m);
  }
  countDelaysFromFirst(result);
  if (!(options.self.focal_sigma > 0.0)) reportFocalDoubts(s, scale_held, result);
  if (s.body) reportBody(*s.body, covariance, result);
  result.given_off_deg = off.degrees;
  result.given_off_share = farthest > 0.0 ? off.metres / farthest : 0.0;
  judge(result, cameras);
  return result;
}

}  // namespace helical
