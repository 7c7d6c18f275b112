#include "engine/simulator/true_rig.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace helical {
namespace {

const CameraModel kTold(640, 480, 500.0, 510.0, 319.5, 239.5, {});

TEST(TrueRig, WithoutAnErrorItIsWhatTheRigSays) {
  const MarkerLayout told = MarkerLayout::paper();
  const MarkerLayout markers = trueMarkers(told, {});
  for (int m = 0; m < told.count(); ++m) EXPECT_EQ(markers.inBody(markerId(m)), told.inBody(markerId(m)));
  EXPECT_EQ(trueModel(cameraId(1), kTold, {}).fx(), kTold.fx());
}

TEST(TrueRig, BallsAreOffByAsMuchAsAskedForAndAlikeForASeed) {
  const MarkerLayout told = MarkerLayout::paper();
  double squares = 0.0;
  int count = 0;
  SimulationOptions options;
  options.marker_error_m = 1e-3;
  for (options.seed = 1; options.seed <= 200; ++options.seed) {
    const MarkerLayout markers = trueMarkers(told, options), again = trueMarkers(told, options);
    for (int m = 0; m < told.count(); ++m) {
      EXPECT_EQ(markers.inBody(markerId(m)), again.inBody(markerId(m)));
      squares += (markers.inBody(markerId(m)) - told.inBody(markerId(m))).squaredNorm();
      count += 3;
    }
  }
  EXPECT_NEAR(std::sqrt(squares / count), 1e-3, 5e-5);
}

TEST(TrueRig, EachCameraHasAFocalLengthOfItsOwn) {
  SimulationOptions options;
  options.focal_error = 0.01;
  const CameraModel one = trueModel(cameraId(0), kTold, options), other = trueModel(cameraId(1), kTold, options);
  EXPECT_NE(one.fx(), other.fx());
  EXPECT_NEAR(one.fx() / kTold.fx(), one.fy() / kTold.fy(), 1e-12);
  EXPECT_NEAR(one.fx(), kTold.fx(), 0.05 * kTold.fx());
  EXPECT_EQ(one.cx(), kTold.cx());
}

TEST(TrueRig, ACalibrationThatIsLoadedMovesNoBallInTheField) {
  const MarkerLayout before = MarkerLayout::paper();
  std::array<Eigen::Vector3d, 4> balls;
  std::copy(before.all().begin(), before.all().end(), balls.begin());
  balls[0].x() += 0.01;
  SimulationOptions options;
  options.markers_before = before;
  options.models_before = {std::nullopt, kTold.withFocalScale(0.99)};
  EXPECT_EQ(trueMarkers(MarkerLayout(balls, before.radius()), options).inBody(markerId(0)), before.inBody(markerId(0)));
  EXPECT_EQ(trueModel(cameraId(0), kTold, options).fx(), kTold.fx());
  EXPECT_EQ(trueModel(cameraId(1), kTold, options).fx(), 0.99 * kTold.fx());
  EXPECT_EQ(trueModel(cameraId(2), kTold, options).fx(), kTold.fx());
}

}  // namespace
}  // namespace helical
