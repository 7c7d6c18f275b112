#include "engine/correspondence/labelling_search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/base/error.h"
#include "engine/correspondence/affine_seed.h"
#include "engine/geometry/camera_perturbation.h"
#include "tests/correspondence/random_views.h"

namespace helical {
namespace {

constexpr double kAngle = 0.26, kDistance = 0.4;  // of the first guess

LabellingFrame frameOf(const RandomView& view) {
  LabellingFrame frame;
  frame.world_from_body = view.world_from_body;
  std::copy(view.pixels.begin(), view.pixels.end(), frame.pixels.begin());
  return frame;
}

LabellingSearch search(const RandomView& view, const RigidTransform& guess,
                       const LabellingSearchOptions& options = {}) {
  const LabellingFrame frame = frameOf(view);
  return searchLabellings(viewCamera(), view.layout, {&frame, 1}, guess, options);
}

TEST(LabellingSearch, FindsLabelsAndPoseWithoutNoise) {
  Random random(1);
  for (int trial = 0; trial < 65; ++trial) {
    const int markers = 4 + trial % (kMaxMarkers - 3);
    const RandomView view = randomView(random, markers, 0.0);
    const LabellingSearch found = search(view, guessOf(view, kAngle, kDistance, random));
    const ScoredLabelling* best = found.best(LabellingCriterion::kNearestPlausible);
    ASSERT_NE(best, nullptr);
    EXPECT_EQ(best->labelling, view.truth) << markers;
    EXPECT_EQ(found.best(LabellingCriterion::kReprojection)->labelling, view.truth) << markers;
    const Vector6d error = cameraPerturbation(view.camera_from_world, best->resection.camera_from_world);
    EXPECT_LT(error.norm(), 1e-5) << markers;
  }
}

TEST(LabellingSearch, ReportsDifferencesFromTheGuessForEveryLabelling) {
  Random random(2);
  const RandomView view = randomView(random, 7, 0.5);
  const RigidTransform guess = guessOf(view, kAngle, kDistance, random);
  LabellingSearchOptions options;
  options.metres_per_radian = 2.0;
  const LabellingSearch found = search(view, guess, options);
  ASSERT_FALSE(found.labellings().empty());
  for (const auto& scored : found.labellings()) {
    if (scored.resection.status == ResectionStatus::kDegenerate) continue;
    const RigidTransform& pose = scored.resection.camera_from_world;
    const Vector6d change = cameraPerturbation(guess, pose);
    EXPECT_NEAR(scored.difference_geodesic, change.tail<3>().norm() + 2.0 * change.head<3>().norm(), 1e-9);
    EXPECT_NEAR(scored.difference_literal,
                (pose.translation - guess.translation).norm() +
                    (logSO3(pose.rotation) - logSO3(guess.rotation)).norm(),
                1e-9);
  }
  const auto least = [&](auto value) {
    double least_value = INFINITY;
    for (const auto& scored : found.labellings())
      if (scored.resection.status != ResectionStatus::kDegenerate)
        least_value = std::min(least_value, value(scored));
    return least_value;
  };
  const auto geodesic = [](const ScoredLabelling& scored) { return scored.difference_geodesic; };
  const auto literal = [](const ScoredLabelling& scored) { return scored.difference_literal; };
  const auto cost = [](const ScoredLabelling& scored) { return scored.resection.cost_px2; };
  EXPECT_EQ(geodesic(*found.best(LabellingCriterion::kGeodesic)), least(geodesic));
  EXPECT_EQ(literal(*found.best(LabellingCriterion::kLiteral)), least(literal));
  EXPECT_EQ(cost(*found.best(LabellingCriterion::kReprojection)), least(cost));
}

TEST(LabellingSearch, FullSearchHoldsWhatTheNestedOneFinds) {
  Random random(3);
  for (int trial = 0; trial < 10; ++trial) {
    const RandomView view = randomView(random, 5, 0.0);
    const RigidTransform guess = guessOf(view, kAngle, kDistance, random);
    LabellingSearchOptions options;
    options.scope = LabellingScope::kEveryPermutation;
    const LabellingSearch full = search(view, guess, options), nested = search(view, guess);
    EXPECT_EQ(full.labellings().size(), 120u);
    EXPECT_LT(nested.labellings().size(), 7u);
    EXPECT_EQ(full.best(LabellingCriterion::kReprojection)->labelling, view.truth);
    for (const auto& scored : nested.labellings())
      EXPECT_TRUE(std::any_of(full.labellings().begin(), full.labellings().end(),
                              [&](const auto& other) { return other.labelling == scored.labelling; }));
  }
}

/// Three balls in one view have several exact poses; a second pose of the helicopter tells which labels hold.
TEST(LabellingSearch, SeveralFramesTellLabelsThatOneCannot) {
  Random random(4);
  constexpr int kTrials = 100;
  int right_once = 0, right_often = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    const RandomView view = randomView(random, 3, 0.5);
    std::vector<LabellingFrame> frames{frameOf(view)};
    for (int i = 0; i < 4; ++i) frames.push_back(frameOf(view, randomHover(random), 0.5, random));
    const RigidTransform guess = guessOf(view, kAngle, kDistance, random);
    const auto right = [&](const LabellingSearch& found) {
      const ScoredLabelling* best = found.best(LabellingCriterion::kReprojection);
      return best && best->labelling == view.truth;
    };
    right_once += right(searchLabellings(viewCamera(), view.layout, {frames.data(), 1}, guess));
    right_often += right(searchLabellings(viewCamera(), view.layout, frames, guess));
  }
  EXPECT_GE(right_often, kTrials * 95 / 100);
  EXPECT_GT(right_often, right_once);
}

TEST(LabellingSearch, TakesPolygonsFromAFrameWithTheLayoutsShape) {
  Random random(5);
  const RandomView view = randomView(random, 8, 0.0);
  std::vector<LabellingFrame> frames(2, frameOf(view));
  for (auto& pixel : frames[0].pixels) pixel = Eigen::Vector2d(pixel.x(), 2.0 * pixel.x());
  const RigidTransform guess = guessOf(view, 0.05, 0.05, random);
  EXPECT_TRUE(searchLabellings(viewCamera(), view.layout, {frames.data(), 1}, guess).labellings().empty());
  EXPECT_FALSE(searchLabellings(viewCamera(), view.layout, frames, guess).labellings().empty());
}

TEST(LabellingSearch, HasNoBestWhereHullsDisagree) {
  Random random(6);
  RandomView view = randomView(random, 4, 0.0);
  view.pixels = {{100, 100}, {200, 100}, {150, 200}, {150, 130}};
  const Eigen::Vector3d square[] = {{0.1, 0.1, 0}, {-0.1, 0.1, 0}, {-0.1, -0.1, 0}, {0.1, -0.1, 0}};
  view.layout = MarkerLayout(square, 0.01);
  const LabellingSearch found = search(view, view.camera_from_world);
  EXPECT_TRUE(found.labellings().empty());
  for (const auto criterion : {LabellingCriterion::kNearestPlausible, LabellingCriterion::kGeodesic,
                               LabellingCriterion::kLiteral, LabellingCriterion::kReprojection})
    EXPECT_EQ(found.best(criterion), nullptr);
}

TEST(LabellingWalk, FindsInSlicesWhatASearchFindsAtOnce) {
  Random random(12);
  for (const int markers : {3, 4, 7, 9}) {
    const RandomView view = randomView(random, markers, 0.3);
    const RigidTransform guess = guessOf(view, kAngle, kDistance, random);
    const LabellingSearch whole = search(view, guess);
    LabellingWalk walk(viewCamera(), view.layout);
    for (int repeat = 0; repeat < 2; ++repeat) {
      walk.start(frameOf(view), guess);
      int slices = 0;
      for (; walk.running(); ++slices) walk.advance(2);
      EXPECT_EQ(slices, static_cast<int>(whole.labellings().size()) / 2 + 1);
      ASSERT_EQ(walk.found().labellings().size(), whole.labellings().size());
      for (std::size_t i = 0; i < whole.labellings().size(); ++i) {
        EXPECT_EQ(walk.found().labellings()[i].labelling, whole.labellings()[i].labelling);
        EXPECT_EQ(walk.found().labellings()[i].resection.cost_px2, whole.labellings()[i].resection.cost_px2);
      }
    }
    walk.start(frameOf(view), guess);
    walk.stop();
    EXPECT_FALSE(walk.running());
  }
}

TEST(LabellingSearch, RefusesOptionsOutOfRange) {
  LabellingSearchOptions options;
  EXPECT_NO_THROW(validate(options));
  options.metres_per_radian = -1.0;
  EXPECT_THROW(validate(options), Error);
  options = {};
  options.alike_chi2 = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(validate(options), Error);
  options = {};
  options.resection.sigma_px = 0.0;
  EXPECT_THROW(validate(options), Error);
}

TEST(AffineSeed, NamesCentroidsWithoutAGuess) {
  Random random(7);
  constexpr int kTrials = 180;
  int right = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    const RandomView view = randomView(random, 5 + trial % (kMaxMarkers - 4), 0.5);
    const auto seeds = affineSeedLabellings(viewCamera(), view.layout, view.pixels);
    right += !seeds.empty() && seeds.front().labelling == view.truth;
    for (std::size_t i = 1; i < seeds.size(); ++i) {
      EXPECT_GE(seeds[i].poses.poses[0].rms_px, seeds[i - 1].poses.poses[0].rms_px);
      EXPECT_FALSE(seeds[i].labelling == seeds[i - 1].labelling);
    }
  }
  EXPECT_GE(right, kTrials * 95 / 100);
}

/// A square looks alike after a quarter turn: all four labellings are offered, the true one among them.
TEST(AffineSeed, OffersEveryTurnOfASquare) {
  Random random(8);
  const Eigen::Vector3d square[] = {
      {0.15, 0.15, -0.05}, {-0.15, 0.15, -0.05}, {-0.15, -0.15, -0.05}, {0.15, -0.15, -0.05}};
  for (int trial = 0; trial < 50; ++trial) {
    RandomView view = randomView(random, 4, 0.5);
    view.layout = MarkerLayout(square, 0.018);
    const LabellingFrame frame = frameOf(view, view.world_from_body, 0.5, random);
    const auto seeds = affineSeedLabellings(viewCamera(), view.layout, {frame.pixels.data(), 4});
    EXPECT_EQ(seeds.size(), 4u);
    EXPECT_TRUE(std::any_of(seeds.begin(), seeds.end(),
                            [&](const auto& seed) { return seed.labelling == view.truth; }));
  }
}

TEST(AffineSeed, HasNothingForPointsOnALine) {
  Random random(9);
  const RandomView view = randomView(random, 4, 0.0);
  const std::vector<Eigen::Vector2d> pixels{{100, 100}, {110, 110}, {120, 120}, {130, 130}};
  EXPECT_TRUE(affineSeedLabellings(viewCamera(), view.layout, pixels).empty());
}

}  // namespace
}  // namespace helical
