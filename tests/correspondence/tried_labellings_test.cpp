#include "engine/correspondence/tried_labellings.h"

#include <gtest/gtest.h>

#include <string>

#include "engine/correspondence/labelling_search.h"
#include "tests/correspondence/random_views.h"

namespace helical {
namespace {

TriedLabelling withValue(float value) {
  TriedLabelling labelling;
  labelling.count = 2;
  labelling.marker[0] = 1;
  labelling.value = value;
  return labelling;
}

TEST(TriedLabellings, KeepTheTakenOneAndTheBestOthersInOrder) {
  TriedLabellings tried;
  tried.add(withValue(5.0F));
  for (const float value : {9.0F, 3.0F, 7.0F, 4.0F, 8.0F, 6.0F, 2.0F}) tried.add(withValue(value));
  ASSERT_EQ(tried.count, TriedLabellings::kMost);
  std::string values;
  for (const TriedLabelling& labelling : tried.all) values += std::to_string(static_cast<int>(labelling.value));
  EXPECT_EQ(values, "523467");
}

TEST(TriedLabellings, AreNamedFromLeftToRight) {
  const std::array<std::uint8_t, 3> markers{4, 12, 0};
  const std::array<Eigen::Vector2d, 3> pixels{Eigen::Vector2d(300, 1), {100, 2}, {200, 3}};
  TriedLabellings tried;
  tried.add(fromLeftToRight(markers, pixels, 0.25));
  tried.add(fromLeftToRight({markers.data(), 2}, pixels, 0.5));
  LabellingNames buffer;
  EXPECT_EQ(writeNames(tried, buffer), "12-0-4 12-4");
  const TriedLabellings read = readNames("12-0-4 12-4");
  ASSERT_EQ(read.count, 2);
  EXPECT_EQ(read.all[0].marker, tried.all[0].marker);
  EXPECT_EQ(read.all[1].count, 2);
}

TEST(TriedLabellings, LongestNamesFitAndNonsenseIsLeftOut) {
  TriedLabellings tried;
  for (int i = 0; i < TriedLabellings::kMost; ++i) {
    TriedLabelling longest;
    longest.count = kMaxMarkers;
    longest.marker.fill(15);
    tried.add(longest);
  }
  LabellingNames buffer;
  EXPECT_EQ(readNames(writeNames(tried, buffer)).all[5].marker, tried.all[5].marker);
  EXPECT_EQ(readNames("").count, 0);
  EXPECT_EQ(readNames("1-2-99-3 x 4").all[0].count, 2);
  EXPECT_EQ(readNames("1-2-99-3 x 4").all[2].marker[0], 4);
  EXPECT_EQ(readNames("1 1 1 1 1 1 1 1 1").count, TriedLabellings::kMost);
}

TEST(TriedLabellings, OfASearchHaveItsBestFirst) {
  Random random(7);
  const RandomView view = randomView(random, 7, 0.3);
  LabellingFrame frame;
  frame.world_from_body = view.world_from_body;
  std::copy(view.pixels.begin(), view.pixels.end(), frame.pixels.begin());
  const LabellingSearch search =
      searchLabellings(viewCamera(), view.layout, {&frame, 1}, guessOf(view, 0.26, 0.4, random));
  const std::span<const Eigen::Vector2d> pixels{frame.pixels.data(), 7};
  const TriedLabellings tried = search.nearest(LabellingCriterion::kNearestPlausible, pixels);
  ASSERT_GE(tried.count, 3);
  const ScoredLabelling* best = search.best(LabellingCriterion::kNearestPlausible);
  EXPECT_EQ(tried.all[0].value, static_cast<float>(best->difference_geodesic));
  for (std::size_t i = 2; i < static_cast<std::size_t>(tried.count); ++i)
    EXPECT_LE(tried.all[i - 1].value, tried.all[i].value);
  EXPECT_EQ(LabellingSearch().nearest(LabellingCriterion::kGeodesic, pixels).count, 0);
}

}  // namespace
}  // namespace helical
