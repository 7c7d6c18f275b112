#include "engine/calibration/rig/rig_solution.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "engine/calibration/rig/camera_delays.h"
#include "engine/calibration/rig/chain_bodies.h"
#include "engine/calibration/rig/chain_points.h"
#include "engine/calibration/rig/point_structure.h"
#include "engine/calibration/rig/rig_bundle.h"
#include "engine/calibration/rig/wide_delays.h"

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
constexpr double kHardlyFitting = 0.25;  // however much lies beyond the gate
constexpr double kFitting = 0.5;         // share of inliers, from which on a camera's stamps are not doubted
constexpr double kChainShare = 0.6, kFirstShare = 0.6;  // of the time

/// A part of a longer work as a whole of its own.
ProgressCallback part(const ProgressCallback& progress, double from, double to) {
  return [&progress, from, to](double done) {
    if (progress) progress(from + (to - from) * std::min(1.0, done));
  };
}

int fewestInliers(const SightingTable& table) {
  return table.kind == TargetKind::kBody ? 3 : 2;
}

double roughTolerance(std::span<const RigCamera> cameras) {
  double widest = 0.0;
  for (const RigCamera& c : cameras) widest = std::max(widest, static_cast<double>(c.model.width()));
  return std::max(2.0, kRoughTolerance * widest);
}

/// Share of the sightings that could agree with another camera's, and do not.
double rejectedShare(const RigSolution& s) {
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

void gateAt(RigSolution& s, double tolerance) {
  if (s.table.kind == TargetKind::kBody)
    gateSightings(s.state, s.cameras, s.table, tolerance, fewestInliers(s.table));
  else
    placePoints(s.state, s.cameras, s.table, tolerance);
  for (Sighting& k : s.table.sightings) k.inlier = k.inlier && !k.adrift;
}

void gate(RigSolution& s, double tolerance_px) {
  s.gate_px = std::clamp(tolerance_px, kTightestGatePx, 3.0 * roughTolerance(s.cameras));
  gateAt(s, s.gate_px);
}

}  // namespace

void refine(RigSolution& s) {
  for (int round = 0; round < kGateRounds; ++round) {
    const double sigma = sightingSigma(s.state, s.cameras, s.table);
    gate(s, kWideGateSigmas * sigma);
    if (rejectedShare(s) > kFewBeyond) gate(s, kGateSigmas * sigma);
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

namespace {

/// Residuals [px, per axis of one without delay] of the sightings that are inliers in both.
std::pair<std::vector<Eigen::Vector2d>, std::vector<Eigen::Vector2d>> commonResiduals(
    const RigSolution& without, const RigSolution& with) {
  std::pair<std::vector<Eigen::Vector2d>, std::vector<Eigen::Vector2d>> both;
  for (std::size_t i = 0; i < with.table.sightings.size(); ++i) {
    const Sighting &a = without.table.sightings[i], &b = with.table.sightings[i];
    if (!a.inlier || !b.inlier) continue;
    const auto of_a = sightingResidual(without.state, without.cameras, without.table, a);
    const auto of_b = sightingResidual(with.state, with.cameras, with.table, b);
    if (!of_a || !of_b) continue;
    const double periods = with.table.late_s[static_cast<std::size_t>(b.camera)] / with.table.period_s;
    both.first.push_back(*of_a);
    both.second.push_back(*of_b / std::sqrt(noiseAfterDelay(with.table.timing, periods).variance));
  }
  return both;
}

/// Less is likelier: residuals are smaller, and as much is explained.
double unlikeliness(const RigSolution& s) {
  return s.sigma_px / std::max(1e-3, s.explained * s.explained);
}

/// Delays and poses in turn, until the delays have settled. `knowing_noise`: once residuals are noise, what a
/// delay gains by averaging it is known, and taken back.
void settleDelays(RigSolution& s, bool knowing_noise, const ProgressCallback& progress) {
  for (int round = 0; round < kDelayRounds; ++round) {
    progress(static_cast<double>(round) / kDelayRounds);
    const double sigma = sightingSigma(s.state, s.cameras, s.table);
    gate(s, kWideGateSigmas * sigma);
    std::vector<double> later_s(s.cameras.size(), 0.0);
    BundleOptions options;
    options.robust_scale_px = kRobustSigmas * sigma;
    options.max_iterations = kDelayIterations;
    options.late_s = &later_s;
    options.sigma_px = sigma;
    options.take_back_averaging = knowing_noise;
    adjustBundle(s.state, s.cameras, s.table, options);
    takeOffDelays(s.table, s.cameras, later_s);
    const bool settled = std::all_of(later_s.begin(), later_s.end(), [&](double later) {
      return std::abs(later) < kSettledPeriods * s.table.period_s;
    });
    if (settled) return;
  }
}

/// Finds how much later than the first each camera saw, and keeps it if it explains the recording better.
void findDelays(RigSolution& s, const ProgressCallback& progress) {
  if (s.table.kind == TargetKind::kStillMarkers || s.state.solvedCameras() < 2) return;
  if (!(s.table.period_s > 0.0)) return;  // one instant
  RigSolution timed = s;
  timed.table.late_s.assign(s.cameras.size(), 0.0);
  settleDelays(timed, false, part(progress, 0.0, 0.5));
  settleDelays(timed, true, part(progress, 0.5, 1.0));
  giveUpAdrift(timed.table);
  refine(timed);
  const auto [without, with] = commonResiduals(s, timed);
  if (unlikeliness(timed) < unlikeliness(s) &&
      delaysAreReal(without, with, freeShare(timed.table), s.cameras.size()))
    s = std::move(timed);
}

RigSolution solveFreely(SightingTable table, std::span<const RigCamera> cameras,
                        const RigCalibrationOptions& options, const ProgressCallback& progress) {
  const auto chain_progress = part(progress, 0.0, kChainShare);
  RigSolution s;
  s.cameras.assign(cameras.begin(), cameras.end());
  s.table = std::move(table);
  const double tolerance = roughTolerance(cameras);
  s.state = s.table.kind == TargetKind::kBody ? chainBodies(cameras, s.table, tolerance, chain_progress)
                                              : chainPoints(cameras, s.table, tolerance, chain_progress);
  refine(s);
  if (!options.trust_stamps) findDelays(s, part(progress, kChainShare, 1.0));
  return s;
}

/// The likelier one of a recording's tables.
RigSolution solveTables(std::vector<SightingTable> tables, std::span<const RigCamera> cameras,
                        const RigCalibrationOptions& options, const ProgressCallback& progress) {
  std::optional<RigSolution> best;
  double least = 0.0, done = 0.0;
  const double each = 1.0 / static_cast<double>(tables.size());
  for (SightingTable& table : tables) {
    RigSolution s = solveFreely(std::move(table), cameras, options, part(progress, done, done + each));
    done += each;
    const double flatters = s.table.timing == Timing::kInterpolated ? kInterpolationFlatters : 1.0;
    const double score = s.state.solvedCameras() < 2 ? 1e300 : flatters * unlikeliness(s);
    if (best && score >= least) continue;
    least = score;
    best = std::move(s);
  }
  return std::move(*best);
}

/// Cameras that could not be placed, or whose stamps may be why much of what they saw does not fit: where
/// next to nothing lies just beyond the gate, it is false centroids.
std::vector<bool> misfits(const RigSolution& s) {
  std::vector<double> all(s.cameras.size(), 0.0), inliers = all;
  for (const Sighting& k : s.table.sightings) {
    all[static_cast<std::size_t>(k.camera)] += 1.0;
    inliers[static_cast<std::size_t>(k.camera)] += k.inlier ? 1.0 : 0.0;
  }
  const std::vector<double> near = nearMisses(s);
  std::vector<bool> misfit(s.cameras.size());
  for (std::size_t c = 0; c < misfit.size(); ++c)
    misfit[c] = !s.state.camera_from_world[c] || beyondDelayReach(s.table, c) ||
                (inliers[c] < kFitting * all[c] && near[c] > kFewNearMisses) ||
                inliers[c] < kHardlyFitting * all[c];
  return misfit;
}

long inliersOf(const RigSolution& s) {
  return std::count_if(s.table.sightings.begin(), s.table.sightings.end(),
                       [](const Sighting& k) { return k.inlier; });
}

/// Where stamps that are more than a frame off may be why cameras do not fit: without that, if more fits
/// then.
void mendStamps(RigSolution& s, PointRows rows, const std::string& file, const RigCalibrationOptions& options,
                const ProgressCallback& progress) {
  const std::vector<bool> misfit = misfits(s);
  if (s.table.kind == TargetKind::kStillMarkers || std::count(misfit.begin(), misfit.end(), true) == 0)
    return;
  const std::vector<double> late_s =
      wideDelays(rows, s.cameras, misfit, s.table.period_s, roughTolerance(s.cameras));
  if (std::all_of(late_s.begin(), late_s.end(), [](double late) { return late == 0.0; })) return;
  for (PointRow& row : rows.rows) row.time_s += late_s[static_cast<std::size_t>(row.camera)];
  const std::vector<RigCamera> cameras = s.cameras;
  RigSolution mended = solveTables(bringTogether(rows, cameras, file), cameras, options, progress);
  const std::vector<bool> still = misfits(mended);
  if (std::count(still.begin(), still.end(), true) >= std::count(misfit.begin(), misfit.end(), true) ||
      inliersOf(mended) * mended.table.thinned_by < inliersOf(s) * s.table.thinned_by)
    return;
  s = std::move(mended);
  s.stamps_late_s = late_s;
}

}  // namespace

std::vector<double> nearMisses(const RigSolution& s) {
  RigSolution wider = s;
  gateAt(wider, 2.0 * s.gate_px);
  std::vector<double> more(s.cameras.size(), 0.0), inliers = more;
  for (std::size_t i = 0; i < s.table.sightings.size(); ++i) {
    const auto c = static_cast<std::size_t>(s.table.sightings[i].camera);
    inliers[c] += s.table.sightings[i].inlier ? 1.0 : 0.0;
    more[c] += wider.table.sightings[i].inlier && !s.table.sightings[i].inlier ? 1.0 : 0.0;
  }
  for (std::size_t c = 0; c < more.size(); ++c) more[c] /= std::max(1.0, inliers[c]);
  return more;
}

RigSolution solveLikeliest(PointRows rows, std::span<const RigCamera> cameras, const std::string& file,
                           const RigCalibrationOptions& options, const ProgressCallback& progress) {
  RigSolution s =
      solveTables(bringTogether(rows, cameras, file), cameras, options, part(progress, 0.0, kFirstShare));
  if (!options.trust_stamps) mendStamps(s, std::move(rows), file, options, part(progress, kFirstShare, 1.0));
  return s;
}

}  // namespace helical
