#include "engine/markers/overlap_split.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "engine/base/random.h"
#include "engine/geometry/rotation.h"
#include "engine/markers/extractor.h"
#include "engine/simulator/scene_renderer.h"
#include "tests/markers/scenes.h"

namespace helical {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using test::Picture;

std::vector<Centroid> centroidsIn(const ImageView& image, const ImageView* empty = nullptr) {
  Extractor extractor(MarkerOptions{});
  if (empty != nullptr)
    extractor.setBackground(*empty);
  else
    extractor.disableBackground();
  Observation found;
  extractor.extract(image, found);
  return {found.centroids.begin(), found.centroids.begin() + found.count};
}

double nearest(const std::vector<Centroid>& found, const Vector2d& truth) {
  double least = 1e9;
  for (const Centroid& centroid : found) least = std::min(least, (centroid.pixel - truth).norm());
  return least;
}

Picture greyPicture() {
  Picture picture(120, 120);
  picture.fill(120, 120, 120);
  return picture;
}

TEST(OverlapSplit, TellsApartTwoBallsThatTouchOrOverlap) {
  Random random(8);
  for (const double radius : {4.0, 6.0, 10.0})
    for (const double apart : {1.3, 1.6, 1.9})
      for (const double angle : {0.0, 0.5, 0.785, 1.3, 2.2}) {
        if (apart * radius < 6.0) continue;  // a waist of less than a pixel
        SCOPED_TRACE(testing::Message() << radius << " px, " << apart << " radii apart, at " << angle);
        const Vector2d along(std::cos(angle), std::sin(angle));
        const Vector2d a(58.3 + random.uniform(), 57.8 + random.uniform()), b = a + apart * radius * along;
        Picture picture = greyPicture();
        picture.drawDisc(a.x(), a.y(), radius, 45, 190, 50);
        picture.drawDisc(b.x(), b.y(), radius, 45, 190, 50);
        picture.addNoise(random, 2.0);
        const auto found = centroidsIn(picture.view());
        ASSERT_EQ(found.size(), 2U);
        EXPECT_LT(nearest(found, a), 0.15);
        EXPECT_LT(nearest(found, b), 0.15);
        for (const Centroid& centroid : found) EXPECT_NEAR(centroid.radius_px, radius, 0.3);
      }
}

TEST(OverlapSplit, LeavesWhatIsNoTwoBalls) {
  Random random(9);
  for (const double length : {0.5, 1.0, 1.5, 2.5}) {  // radii: a ball smeared by its motion
    Picture picture = greyPicture();
    for (double at = 0.0; at <= 1.0; at += 0.02)
      picture.drawDisc(50.0 + at * length * 7.0, 60.2 + 0.4 * at * length * 7.0, 7.0, 45, 190, 50);
    picture.addNoise(random, 2.0);
    EXPECT_EQ(centroidsIn(picture.view()).size(), 1U) << length;
  }
  for (const double hidden : {-0.4, 0.0, 0.5}) {  // radii from its centre, where something covers the ball
    Picture picture = greyPicture();
    picture.drawDisc(60.3, 60.6, 8.0, 45, 190, 50);
    for (int y = 0; y < picture.height(); ++y)
      for (int x = static_cast<int>(60.3 + 8.0 * hidden); x < picture.width(); ++x)
        std::copy_n(std::array<std::uint8_t, 3>{40, 40, 40}.data(), 3, picture.pixel(x, y));
    picture.addNoise(random, 2.0);
    EXPECT_EQ(centroidsIn(picture.view()).size(), 1U) << hidden;
  }
}

/// Looks at the helicopter from 1.6 m, low enough for the near balls to cover the far ones.
RigidTransform lowCamera() {
  const double elevation = toRadians(3.0);
  const Vector3d back(std::cos(elevation), 0.0, std::sin(elevation));
  const Vector3d z = -back, x = z.cross(Vector3d::UnitZ()).normalized(), y = z.cross(x);
  Eigen::Matrix3d axes;
  axes << x.transpose(), y.transpose(), z.transpose();
  const Eigen::Quaterniond rotation(axes);
  return {rotation, -(rotation * (Vector3d(0, 0, 0.5) + 1.6 * back))};
}

TEST(OverlapSplit, NamesBothOfTwoRenderedBallsInARow) {
  const CameraModel model(640, 480, 567.6, 567.6, 319.5, 239.5);
  const MarkerLayout markers = MarkerLayout::paper();
  const RigidTransform camera = lowCamera();
  SceneRenderer renderer(model, markers, {});
  const ImageView room = renderer.render(camera, std::nullopt, 0.0);
  const std::vector<std::uint8_t> pixels(room.data, room.data + room.stride * room.height);
  const ImageView empty{pixels.data(), room.width, room.height, room.stride, room.format};
  int pairs = 0, both = 0;
  for (double yaw = 0.0; yaw < 2.0 * kPi; yaw += 0.04) {
    HelicopterView view;
    view.world_from_body = {Eigen::Quaterniond(Eigen::AngleAxisd(yaw, Vector3d::UnitZ())), {0, 0, 0.5}};
    std::vector<Vector2d> centres;
    for (const Vector3d& marker : markers.all())
      centres.push_back(*model.project(camera * (view.world_from_body * marker)));
    const double radius = model.fx() * markers.radius() / 1.6;
    for (std::size_t a = 0; a < centres.size(); ++a)
      for (std::size_t b = a + 1; b < centres.size(); ++b) {
        const double apart = (centres[a] - centres[b]).norm() / radius;
        if (apart < 1.4 || apart > 2.0) continue;
        const auto found = centroidsIn(renderer.render(camera, view, 0.0), &empty);
        ++pairs;
        EXPECT_LE(found.size(), centres.size());
        both += nearest(found, centres[a]) < 0.5 && nearest(found, centres[b]) < 0.5 ? 1 : 0;
      }
  }
  std::printf("%d pairs of rendered balls 1.4 to 2 radii apart, both found of %d\n", pairs, both);
  // Of some the skids hide more than half of the far ball: those stay one centroid.
  EXPECT_GE(pairs, 20);
  EXPECT_GE(both, 0.75 * pairs);
}

}  // namespace
}  // namespace helical
