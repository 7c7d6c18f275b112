#include <time.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cstdio>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/experiment.h"
#include "app/progress.h"
#include "app/random_view.h"
#include "engine/base/error.h"
#include "engine/correspondence/affine_seed.h"

namespace helical {
namespace {

constexpr int kFewestMarkers = 3;
constexpr int kMostMarkersForFullSearch = 7;  // 5040 labellings; of 8 a search takes seconds
constexpr int kFullSearchRuns = 10;           // only its time is asked for

struct Arguments {
  std::string markers = "3-15";
  int runs = 200;
  std::uint64_t seed = 1;
  bool json = false;
};

struct Range {
  int first, last;
};

Range parseRange(const std::string& text) {
  Range range{0, 0};
  const char* const end = text.data() + text.size();
  const auto first = std::from_chars(text.data(), end, range.first);
  auto last = first;
  range.last = range.first;
  if (first.ec == std::errc() && first.ptr != end && *first.ptr == '-')
    last = std::from_chars(first.ptr + 1, end, range.last);
  if (first.ec != std::errc() || last.ec != std::errc() || last.ptr != end || range.first < kFewestMarkers ||
      range.last > kMaxMarkers || range.first > range.last)
    throw Error(ErrorKind::kInput, "--markers " + text + " is not understood", {},
                "give a number or a range from " + std::to_string(kFewestMarkers) + " to " +
                    std::to_string(kMaxMarkers) + ", as in 3-15");
  return range;
}

/// Processor time of this thread [us]: other work on the machine does not count.
double threadMicroseconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e6 * static_cast<double>(now.tv_sec) + 1e-3 * static_cast<double>(now.tv_nsec);
}

double timed(auto&& work) {
  const double start = threadMicroseconds();
  work();
  return threadMicroseconds() - start;
}

/// Sums over the runs with one number of markers.
struct Tally {
  int markers = 0;
  int runs = 0;
  double labellings = 0.0;
  double most_labellings = 0.0;
  double time_us = 0.0;
  double seed_time_us = 0.0;
  double full_time_us = 0.0;
  int full_runs = 0;
  int consistent = 0;
  int right_plausible = 0;
  int right_geodesic = 0;
  int right_literal = 0;
  int right_reprojection = 0;
  int right_seed = 0;

  double share(int n) const { return static_cast<double>(n) / runs; }
  bool boundHolds() const { return most_labellings <= theoremOneBound(markers) * (1.0 + 1e-12); }
};

bool isRight(const ScoredLabelling* found, const Labelling& truth) {
  return found && found->labelling == truth;
}

void searchNested(const RandomView& view, Tally& tally) {
  LabellingSearch search;
  tally.time_us += timed([&] {
    search = searchLabellings(randomViewCamera(), view.layout, {&view.frame, 1}, view.guess);
  });
  const auto& all = search.labellings();
  tally.consistent += std::any_of(
      all.begin(), all.end(), [&](const ScoredLabelling& scored) { return scored.labelling == view.truth; });
  tally.right_plausible += isRight(search.best(LabellingCriterion::kNearestPlausible), view.truth);
  tally.right_geodesic += isRight(search.best(LabellingCriterion::kGeodesic), view.truth);
  tally.right_literal += isRight(search.best(LabellingCriterion::kLiteral), view.truth);
  tally.right_reprojection += isRight(search.best(LabellingCriterion::kReprojection), view.truth);
}

void countLabellings(const RandomView& view, Tally& tally) {
  const ConvexLayers image =
      peelConvexLayers({view.frame.pixels.data(), static_cast<std::size_t>(tally.markers)});
  const auto count = static_cast<double>(NestedLabellings(image, image, ViewSide::kAbove).count());
  tally.labellings += count;
  tally.most_labellings = std::max(tally.most_labellings, count);
}

void searchFromSeed(const RandomView& view, Tally& tally) {
  if (tally.markers < 4) return;
  std::vector<SeedLabelling> seeds;
  tally.seed_time_us += timed([&] {
    seeds = affineSeedLabellings(randomViewCamera(), view.layout,
                                 {view.frame.pixels.data(), static_cast<std::size_t>(tally.markers)});
  });
  tally.right_seed += !seeds.empty() && seeds.front().labelling == view.truth;
}

void searchFully(const RandomView& view, Tally& tally) {
  if (tally.markers > kMostMarkersForFullSearch || tally.full_runs == kFullSearchRuns) return;
  LabellingSearchOptions options;
  options.scope = LabellingScope::kEveryPermutation;
  tally.full_time_us += timed([&] {
    searchLabellings(randomViewCamera(), view.layout, {&view.frame, 1}, view.guess, options);
  });
  ++tally.full_runs;
}

Tally study(int markers, const Arguments& arguments, const std::function<void(double)>& progress) {
  Tally tally;
  tally.markers = markers;
  Random random = Random(arguments.seed).fork(static_cast<std::uint64_t>(markers));
  for (; tally.runs < arguments.runs; ++tally.runs) {
    const RandomView view = randomView(random, markers);
    countLabellings(view, tally);
    searchNested(view, tally);
    searchFromSeed(view, tally);
    searchFully(view, tally);
    progress(static_cast<double>(tally.runs) / arguments.runs);
  }
  return tally;
}

nlohmann::json jsonOf(const Tally& tally) {
  using nlohmann::json;
  const bool seeded = tally.markers >= 4;
  return {{"n", tally.markers},
          {"labelings_mean", tally.labellings / tally.runs},
          {"labelings_max", tally.most_labellings},
          {"bound", theoremOneBound(tally.markers)},
          {"bound_holds", tally.boundHolds()},
          {"full_search", fullSearchCount(tally.markers)},
          {"time_us", tally.time_us / tally.runs},
          {"full_search_time_us", tally.full_runs > 0 ? json(tally.full_time_us / tally.full_runs) : json()},
          {"affine_seed_time_us", seeded ? json(tally.seed_time_us / tally.runs) : json()},
          {"hull_consistent", tally.share(tally.consistent)},
          {"right_min_de", tally.share(tally.right_plausible)},
          {"right_min_de_geodesic", tally.share(tally.right_geodesic)},
          {"right_min_de_literal", tally.share(tally.right_literal)},
          {"right_min_reprojection", tally.share(tally.right_reprojection)},
          {"right_affine_seed", seeded ? json(tally.share(tally.right_seed)) : json()}};
}

std::string reportJson(const Arguments& arguments, const std::vector<Tally>& tallies) {
  nlohmann::json report{{"runs", arguments.runs}, {"seed", arguments.seed}};
  for (const auto& tally : tallies) report["markers"].push_back(jsonOf(tally));
  return report.dump(2) + "\n";
}

std::string cell(const char* format, double value) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, format, value);
  return buffer;
}

/// A figure that some rows do not have.
std::string cellOr(bool there, const char* format, double value, int width) {
  const std::string text = there ? cell(format, value) : "-";
  return std::string(static_cast<std::size_t>(std::max(0, width - static_cast<int>(text.size()))), ' ') +
         text;
}

std::string rowOf(const Tally& tally) {
  const bool seeded = tally.markers >= 4, full = tally.full_runs > 0;
  std::string row = cell("%3.0f", tally.markers) + cell(" %6.1f", tally.labellings / tally.runs) +
                    cell(" %4.0f", tally.most_labellings) + cell(" %9.1f", theoremOneBound(tally.markers)) +
                    cell(" %8.3g", fullSearchCount(tally.markers)) +
                    cell(" %9.0f", tally.time_us / tally.runs);
  row += cellOr(full, "%.0f", full ? tally.full_time_us / tally.full_runs : 0.0, 13);
  row += cell(" %10.3f", tally.share(tally.consistent));
  for (const int right :
       {tally.right_plausible, tally.right_geodesic, tally.right_literal, tally.right_reprojection})
    row += cell(" %8.3f", tally.share(right));
  return row + cellOr(seeded, "%.3f", tally.share(tally.right_seed), 9) + "\n";
}

constexpr const char* kTableHead =
    "      labelings   theorem     full    search  full search       hull -------- share found right by "
    "--------\n"
    "  N   mean  max   3^(N/3)       N!        us           us consistent       De   De geo   De eq9   "
    "reproj     seed\n";

constexpr const char* kTableFoot =
    "De: nearest to the first guess of the labelings that explain the pixels; De geo: nearest of all, by "
    "angle;\n"
    "De eq9: as the paper prints it; reproj: least reprojection error; seed: affine seed, without any "
    "guess.\n";

std::string reportText(const Arguments& arguments, const std::vector<Tally>& tallies) {
  std::string text =
      "Which centroid is which marker, over " + std::to_string(arguments.runs) +
      " random views for each number of markers, camera 15 degrees and 0.4 m off at first\n\n" + kTableHead;
  bool bound_holds = true;
  for (const auto& tally : tallies) {
    text += rowOf(tally);
    bound_holds = bound_holds && tally.boundHolds();
  }
  return text + "\nTheorem 1's bound " + (bound_holds ? "held in every view" : "was BROKEN") + ".\n" +
         kTableFoot;
}

int runExperiment(const Arguments& arguments) {
  const Range range = parseRange(arguments.markers);
  std::vector<Tally> tallies;
  {
    Progress progress("Naming centroids");
    const int rows = range.last - range.first + 1;
    for (int n = range.first; n <= range.last; ++n)
      tallies.push_back(study(n, arguments, [&](double done) {
        progress.update((n - range.first + done) / rows, std::to_string(n) + " markers");
      }));
  }
  const std::string report = arguments.json ? reportJson(arguments, tallies) : reportText(arguments, tallies);
  if (std::fputs(report.c_str(), stdout) < 0 || std::fflush(stdout) != 0)
    throw Error(ErrorKind::kSystem, "the report cannot be written to standard output", {},
                "check the disk or the pipe");
  return std::all_of(tallies.begin(), tallies.end(), [](const Tally& tally) { return tally.boundHolds(); })
             ? 0
             : 1;
}

}  // namespace

void addCorrespondenceExperiment(CLI::App& experiments, int& exit_code) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = experiments.add_subcommand("correspondence",
                                                 "Which centroid is which marker: labelings, time, success");
  command->add_option("--markers", arguments->markers, "Numbers of markers, as in 3-15 or 6")
      ->capture_default_str();
  command->add_option("--runs", arguments->runs, "Random views for each number of markers")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str();
  command->add_option("--seed", arguments->seed, "Seed of everything that is drawn at random")
      ->capture_default_str();
  command->add_flag("--json", arguments->json, "Print one JSON object");
  command->callback([arguments, &exit_code] { exit_code = runExperiment(*arguments); });
}

}  // namespace helical
