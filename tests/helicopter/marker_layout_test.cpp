#include "engine/helicopter/marker_layout.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/base/error.h"
#include "engine/geometry/rotation.h"

namespace helical {
namespace {

TEST(MarkerLayout, ThePapersHasFourMarkersInOnePlaneAndOneHeading) {
  const MarkerLayout layout = MarkerLayout::paper();
  ASSERT_EQ(layout.count(), 4);
  EXPECT_EQ(layout.all().size(), 4u);
  for (int i = 0; i < 4; ++i) EXPECT_EQ(layout.inBody(markerId(i)).z(), layout.inBody(markerId(0)).z());
  // Turned by any number of quarters the markers lie elsewhere, by a centimetre RMS: the heading can be told.
  for (int quarters = 1; quarters <= 3; ++quarters) {
    const Eigen::AngleAxisd turn(quarters * 0.5 * kPi, Eigen::Vector3d::UnitZ());
    double squares = 0.0;
    for (const auto& marker : layout.all()) {
      double nearest = 1.0;
      for (const auto& other : layout.all()) nearest = std::min(nearest, (turn * marker - other).norm());
      squares += nearest * nearest;
    }
    EXPECT_GT(std::sqrt(squares / layout.count()), 0.01) << quarters;
  }
}

TEST(MarkerLayout, RefusesWhatGivesNoPose) {
  const std::vector<Eigen::Vector3d> line{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  const std::vector<Eigen::Vector3d> triangle{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const std::vector<Eigen::Vector3d> many(kMaxMarkers + 1, Eigen::Vector3d::Zero());
  EXPECT_THROW(MarkerLayout({line.data(), 2}, 0.02), Error);
  EXPECT_THROW(MarkerLayout(line, 0.02), Error);
  EXPECT_THROW(MarkerLayout(many, 0.02), Error);
  EXPECT_THROW(MarkerLayout(triangle, 0.0), Error);
  EXPECT_NO_THROW(MarkerLayout(triangle, 0.02));
}

}  // namespace
}  // namespace helical
