#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "engine/config/rig_config.h"
#include "engine/experiments/flight_trace.h"
#include "engine/experiments/statistics.h"
#include "engine/flight/flight_plan.h"

namespace helical {

/// The experiments of the paper (section IV): cameras 1 and 2 fly the helicopter, camera 3 is calibrated in
/// flight from a first guess 15 degrees and 0.4 m off; from 13 s to the landing a white board covers
/// camera 2. 1 % of the centroids are thrown aside, 3 % of the balls are lost. Experiment A calibrates by
/// Gauss-Newton in each frame, B by the particle filter; beside them camera 1 alone, and what Helical does by
/// default. Each arm flies with both trackers, all on the same seeds with the same controller. With the
/// paper's tracker camera 3 goes on learning after the switch, from the pose that it helps to find, as the
/// paper's does; with ours it learns only from a pose that other cameras vouch for.
struct MatsukawaArm {
  std::string name;        ///< "camera-1-alone", "A", "B", "default"
  std::string tracker;     ///< "paper", "helical"
  std::string calibrator;  ///< empty: camera 3 stays un-calibrated
};

struct MatsukawaOptions {
  int runs = 1;
  std::uint64_t seed = 1;  ///< of the first flight; the others follow it
  bool images = true;
};

/// One flight, reduced to what is reported. Camera 3's figures are NaN where it is not calibrated or the
/// flight ended before.
struct MatsukawaFlight {
  std::uint64_t seed = 0;
  std::string outcome;                ///< as `helical fly` has it
  double pose_rms_after_cover = 0.0;  ///< of the tracked position, in the air with camera 2 covered [m]
  std::uint64_t camera3_frames = 0;   ///< with camera 2 covered and the rotors turning
  std::uint64_t camera3_used = 0;     ///< of those, the ones that the pose was taken from
  double camera3_error_m = 0.0;       ///< when camera 2 is covered
  double camera3_error = 0.0;         ///< rad, likewise
  double camera3_end_error_m = 0.0;   ///< when the flight is over
  double camera3_end_error = 0.0;     ///< rad
};

struct Spread {
  double median = 0.0;
  double p90 = 0.0;
};

/// An arm over all seeds.
struct MatsukawaResult {
  MatsukawaArm arm;
  std::vector<MatsukawaFlight> flights;  ///< in the order of seeds
  FlightTrace trace;                     ///< of the first seed

  int landed() const;
  Proportion landedShare() const { return proportion(landed(), static_cast<int>(flights.size())); }
  double camera3UsedShare() const;  ///< of the frames of all flights
  /// Median and 90th percentile over the flights that have the figure.
  Spread spread(double MatsukawaFlight::*figure) const;
};

/// The four arms with the paper's tracker, then with ours.
std::vector<MatsukawaArm> matsukawaArms();

/// Flies every arm over the seeds. `rig`: the paper's; `plan`: to hover. Progress is 0..1, with a word on
/// what is being flown. Throws Error.
std::vector<MatsukawaResult> flyMatsukawa2010(
    const RigConfig& rig, const FlightPlan& plan, const MatsukawaOptions& options,
    const std::function<void(double, const std::string&)>& progress);

}  // namespace helical
