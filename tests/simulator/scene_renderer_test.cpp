#include "engine/simulator/scene_renderer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <vector>

#include "engine/base/random.h"
#include "engine/geometry/rotation.h"
#include "engine/markers/extractor.h"

namespace helical {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kFramePeriod = 1.0 / 60.0;
constexpr std::array<double, 3> kAzimuthsDeg{-45.0, 45.0, 180.0};

CameraModel cameraModel() {
  return {640, 480, 567.6, 567.6, 319.5, 239.5, {-0.05, 0.01, 0.0, 0.0, 0.0}};
}

/// Looks at a point above the pad from 2.7 m.
RigidTransform cameraAt(double azimuth, double elevation = toRadians(40.0)) {
  const Vector3d target(0, 0, 0.3);
  const Vector3d back(std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
                      std::sin(elevation));
  const Vector3d z = -back, x = z.cross(Vector3d::UnitZ()).normalized(), y = z.cross(x);
  Eigen::Matrix3d rotation;
  rotation << x.transpose(), y.transpose(), z.transpose();
  const Eigen::Quaterniond q(rotation);
  return {q, -(q * (target + 2.7 * back))};
}

/// A hover that is not perfect: +-5 cm, +-4 degrees of tilt, +-8 degrees of yaw.
HelicopterView hoverAt(double t) {
  HelicopterView view;
  view.world_from_body.translation = {0.05 * std::sin(1.9 * t), 0.05 * std::sin(2.3 * t + 1.0),
                                      0.35 + 0.05 * std::sin(1.3 * t + 2.0)};
  view.world_from_body.rotation =
      expSO3({0, 0, toRadians(8.0) * std::sin(0.9 * t)}) *
      expSO3({toRadians(4.0) * std::sin(3.1 * t), toRadians(4.0) * std::sin(2.7 * t + 0.5), 0});
  view.upper_rotor_angle = 189.0 * t;
  view.lower_rotor_angle = -199.3 * t;
  return view;
}

/// What the extractor makes of rendered markers, over one camera's flight.
struct Accuracy {
  std::array<std::vector<Vector2d>, kMaxMarkers> errors;  ///< of one marker in consecutive frames
  double whole_squares = 0.0;  ///< of errors per axis, of balls that show at least 0.8 of their area
  int whole = 0;
  double hidden_squares = 0.0;
  int hidden = 0;
  int expected = 0;
  int dropped = 0;
  int merged = 0;
  int false_markers = 0;
  int frames = 0;

  double rms() const;
  double meanOffset(int marker) const;
  double autocovariance(int lag) const;
};

double Accuracy::rms() const {
  double sum = 0;
  int count = 0;
  for (const auto& marker : errors)
    for (const auto& e : marker) sum += e.squaredNorm(), count += 2;
  return std::sqrt(sum / std::max(1, count));
}

double Accuracy::meanOffset(int marker) const {
  Vector2d sum = Vector2d::Zero();
  const auto& all = errors[static_cast<std::size_t>(marker)];
  for (const auto& e : all) sum += e;
  return (sum / static_cast<double>(all.size())).norm();
}

double Accuracy::autocovariance(int lag) const {
  double sum = 0;
  int count = 0;
  for (const auto& marker : errors)
    for (std::size_t i = 0; i + static_cast<std::size_t>(lag) < marker.size(); ++i)
      sum += marker[i].dot(marker[i + static_cast<std::size_t>(lag)]), count += 2;
  return sum / std::max(1, count);
}

/// A ball's place in the image, and the area of its disc there.
struct Truth {
  Vector2d pixel;
  double area_px;
};

void addError(const Centroid& found, const Truth& truth, Accuracy& accuracy, std::size_t marker) {
  const Vector2d error = found.pixel - truth.pixel;
  accuracy.errors[marker].push_back(error);
  const bool is_whole = found.area_px >= 0.8 * truth.area_px;
  (is_whole ? accuracy.whole : accuracy.hidden) += 1;
  (is_whole ? accuracy.whole_squares : accuracy.hidden_squares) += 0.5 * error.squaredNorm();
}

void compare(const Observation& found, const std::vector<Truth>& truth, Accuracy& accuracy) {
  constexpr double kGate = 5.0;  ///< px, about a ball's radius
  std::array<int, kMaxCentroids> uses{};
  for (std::size_t m = 0; m < truth.size(); ++m) {
    ++accuracy.expected;
    int best = -1;
    double nearest = kGate;
    for (int i = 0; i < found.count; ++i) {
      const double distance = (found.centroids[static_cast<std::size_t>(i)].pixel - truth[m].pixel).norm();
      if (distance < nearest) nearest = distance, best = i;
    }
    if (best < 0) {
      ++accuracy.dropped;
      continue;
    }
    if (++uses[static_cast<std::size_t>(best)] == 2) ++accuracy.merged;
    addError(found.centroids[static_cast<std::size_t>(best)], truth[m], accuracy, m);
  }
  for (int i = 0; i < found.count; ++i)
    accuracy.false_markers += uses[static_cast<std::size_t>(i)] == 0 ? 1 : 0;
}

Accuracy fly(double azimuth_deg, std::uint64_t seed, double duration_s) {
  const CameraModel model = cameraModel();
  const MarkerLayout layout = MarkerLayout::paper();
  const RigidTransform camera_from_world = cameraAt(toRadians(azimuth_deg));
  SceneRenderer renderer(model, layout, {.seed = seed});
  // The plain centroid: how far it is off is what tells whether the pictures are as imperfect as real ones.
  MarkerOptions options;
  options.estimator = CentroidEstimator::kBinary;
  Extractor extractor(options);
  Observation found;
  double t = 0.0;
  for (; !extractor.hasBackground(); t += kFramePeriod)
    extractor.extract(renderer.render(camera_from_world, std::nullopt, t), found);
  Accuracy accuracy;
  for (const double end = t + duration_s; t < end; t += kFramePeriod) {
    const HelicopterView view = hoverAt(t);
    extractor.extract(renderer.render(camera_from_world, view, t), found);
    std::vector<Truth> truth;
    for (const Vector3d& marker : layout.all()) {
      const Vector3d in_camera = camera_from_world * (view.world_from_body * marker);
      const double radius_px = model.fx() * layout.radius() / in_camera.z();
      truth.push_back({*model.project(in_camera), kPi * radius_px * radius_px});
    }
    compare(found, truth, accuracy);
    ++accuracy.frames;
  }
  return accuracy;
}

class SceneRendererSeenFrom : public testing::TestWithParam<double> {};

TEST_P(SceneRendererSeenFrom, GivesCentroidsCloseToTheTrueProjections) {
  const Accuracy accuracy = fly(GetParam(), 7, 12.0);
  const double white = std::sqrt(std::max(0.0, accuracy.autocovariance(0) - accuracy.autocovariance(1)));
  std::printf(
      "camera at %4.0f deg: rms %.3f px per axis, of it frame to frame %.3f; dropped %.2f %%, merged %.2f "
      "%%, false %.2f %%\n",
      GetParam(), accuracy.rms(), white, 100.0 * accuracy.dropped / accuracy.expected,
      100.0 * accuracy.merged / accuracy.expected, 100.0 * accuracy.false_markers / accuracy.frames);
  std::printf("  share of variance left after frames:");
  for (const int lag : {1, 2, 4, 8, 16, 32, 64, 128})
    std::printf(" %d: %.2f", lag, accuracy.autocovariance(lag) / accuracy.autocovariance(0));
  std::printf("\n  whole balls: rms %.3f; partly hidden: %.1f %%, rms %.3f",
              std::sqrt(accuracy.whole_squares / std::max(1, accuracy.whole)),
              100.0 * accuracy.hidden / (accuracy.whole + accuracy.hidden),
              std::sqrt(accuracy.hidden_squares / std::max(1, accuracy.hidden)));
  std::printf("\n  mean offset of each marker [px]:");
  for (int m = 0; m < 4; ++m) std::printf(" %.3f", accuracy.meanOffset(m));
  std::printf("\n");
  EXPECT_LT(accuracy.rms(), 0.35);
  EXPECT_GT(accuracy.rms(), 0.03);
  EXPECT_LT(std::sqrt(accuracy.whole_squares / accuracy.whole), 0.2);
  for (int m = 0; m < 4; ++m) EXPECT_LT(accuracy.meanOffset(m), 0.3);
  EXPECT_LT(accuracy.dropped, 0.02 * accuracy.expected);
  EXPECT_LT(accuracy.merged, 0.02 * accuracy.expected);
  EXPECT_LT(accuracy.false_markers, 0.02 * accuracy.frames);
}

INSTANTIATE_TEST_SUITE_P(ThreeSides, SceneRendererSeenFrom, testing::ValuesIn(kAzimuthsDeg));

TEST(SceneRenderer, ShowsNothingOfAMarkersColourInAnEmptyField) {
  SceneRenderer renderer(cameraModel(), MarkerLayout::paper(), {.seed = 3});
  for (const double azimuth : kAzimuthsDeg) {
    Extractor with_background(MarkerOptions{}), by_colour(MarkerOptions{});
    by_colour.disableBackground();
    Observation found;
    for (int frame = 0; frame < 100; ++frame) {
      const ImageView image = renderer.render(cameraAt(toRadians(azimuth)), std::nullopt, 0.3 * frame);
      with_background.extract(image, found);
      EXPECT_EQ(found.count, 0);
      by_colour.extract(image, found);
      EXPECT_EQ(found.count, 0);
    }
  }
}

std::vector<std::uint8_t> pixelsOf(const ImageView& image) {
  return {image.data, image.data + static_cast<std::ptrdiff_t>(image.stride) * image.height};
}

TEST(SceneRenderer, RepeatsForASeed) {
  SceneRenderer a(cameraModel(), MarkerLayout::paper(), {.seed = 5}),
      b(cameraModel(), MarkerLayout::paper(), {.seed = 5});
  SceneRenderer other(cameraModel(), MarkerLayout::paper(), {.seed = 6});
  const RigidTransform camera = cameraAt(0.3);
  for (int frame = 0; frame < 5; ++frame) {
    const double t = frame * kFramePeriod;
    const auto picture = pixelsOf(a.render(camera, hoverAt(t), t, 0.1 * frame));
    EXPECT_EQ(picture, pixelsOf(b.render(camera, hoverAt(t), t, 0.1 * frame)));
    EXPECT_NE(picture, pixelsOf(other.render(camera, hoverAt(t), t, 0.1 * frame)));
  }
}

TEST(SceneRenderer, NoiseIsNewInEveryFrame) {
  SceneRenderer renderer(cameraModel(), MarkerLayout::paper(),
                         {.seed = 5, .image_noise = 2.0, .light_drift = 0.0});
  std::vector<std::vector<std::uint8_t>> pictures;
  for (int frame = 0; frame < 24; ++frame)
    pictures.push_back(pixelsOf(renderer.render(cameraAt(0.3), std::nullopt, 0)));
  double squares = 0.0;
  int different = 0;
  for (std::size_t i = 1; i < pictures.size(); ++i) {
    if (pictures[i] == pictures[i - 1]) continue;
    ++different;
    double sum = 0.0;
    for (std::size_t k = 0; k < pictures[i].size(); ++k) {
      const double d = pictures[i][k] - pictures[i - 1][k];
      sum += d * d;
    }
    squares += sum / static_cast<double>(pictures[i].size());
  }
  EXPECT_EQ(different, 23);
  EXPECT_LT(std::sqrt(squares / different / 2.0), 2.3);
  EXPECT_GT(std::sqrt(squares / different / 2.0), 1.2);
}

TEST(SceneRenderer, BoardHidesWhatItCovers) {
  SceneRenderer renderer(cameraModel(), MarkerLayout::paper(), {.seed = 5});
  Extractor extractor(MarkerOptions{});
  extractor.disableBackground();
  Observation found;
  const HelicopterView view = hoverAt(0.0);
  extractor.extract(renderer.render(cameraAt(0.3), view, 0.0, 0.0), found);
  EXPECT_EQ(found.count, 4);
  extractor.extract(renderer.render(cameraAt(0.3), view, 0.0, 0.5), found);
  EXPECT_LT(found.count, 4);
  for (int i = 0; i < found.count; ++i)
    EXPECT_GE(found.centroids[static_cast<std::size_t>(i)].pixel.x(), 320.0);
  extractor.extract(renderer.render(cameraAt(0.3), view, 0.0, 1.0), found);
  EXPECT_EQ(found.count, 0);
}

TEST(SceneRenderer, DrawsAHelicopterThatFillsOrLeavesThePicture) {
  SceneRenderer renderer(cameraModel(), MarkerLayout::paper(), {.seed = 5});
  const RigidTransform camera = cameraAt(0.0);
  const Vector3d centre = camera.inverseTranslation();
  const Vector3d ahead = camera.rotation.conjugate() * Vector3d::UnitZ();
  const Vector3d right = camera.rotation.conjugate() * Vector3d::UnitX();
  for (const double distance : {-0.5, 0.0, 0.03, 0.1, 0.2, 0.4, 1.0, 5.0, 100.0})
    for (const double aside : {-2.0, -0.5, 0.0, 0.5, 2.0}) {
      HelicopterView view;
      view.world_from_body.translation = centre + distance * ahead + aside * right;
      EXPECT_EQ(renderer.render(camera, view, 0.0).width, 640);
    }
}

/// The ball nearer to the camera hides the other, whichever is drawn first.
TEST(SceneRenderer, NearBallHidesFarBall) {
  const std::array<Vector3d, 3> markers{{{-0.12, 0, 0}, {0.12, 0, 0}, {0, 0.2, 0.1}}};
  for (const double azimuth : {0.0, kPi}) {
    SceneRenderer renderer(cameraModel(), MarkerLayout(markers, 0.018), {.seed = 5});
    Extractor extractor(MarkerOptions{});
    extractor.disableBackground();
    Observation found;
    const RigidTransform camera = cameraAt(azimuth, 0.0);
    HelicopterView view;
    view.world_from_body.translation = {0, 0, 0.3};
    extractor.extract(renderer.render(camera, view, 0.0), found);
    ASSERT_EQ(found.count, 2);
    const double near_depth = 2.7 - 0.12;
    EXPECT_NEAR(found.centroids[0].radius_px, 567.6 * 0.018 / near_depth, 0.5);
  }
}

}  // namespace
}  // namespace helical
