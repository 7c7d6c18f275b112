#include "app/random_view.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/geometry/camera_perturbation.h"

namespace helical {
namespace {

constexpr int kSquare = 4;           // markers of the paper's layout, almost a square
constexpr double kHalfWidth = 0.17;  // of the layout [m]
constexpr double kSquareJitter = 0.03;
constexpr double kClosestMarkers = 0.025;
constexpr double kLeastParallelogram = 0.005;  // [m^2]
constexpr double kMarkerHeight = -0.05;
constexpr double kMarkerRadius = 0.012;
constexpr double kSigmaPx = 0.5;

Eigen::Vector3d randomDirection(Random& random) {
  return Eigen::Vector3d(random.normal(), random.normal(), random.normal()).normalized();
}

MarkerLayout randomSquare(Random& random) {
  std::array<Eigen::Vector3d, kSquare> markers;
  const double middle = kHalfWidth - kSquareJitter;
  for (std::size_t i = 0; i < kSquare; ++i)
    markers[i] = {(i == 0 || i == 3 ? middle : -middle) + random.uniform(-kSquareJitter, kSquareJitter),
                  (i < 2 ? middle : -middle) + random.uniform(-kSquareJitter, kSquareJitter), kMarkerHeight};
  return MarkerLayout(markers, kMarkerRadius);
}

std::vector<Eigen::Vector3d> randomMarkers(Random& random, int count) {
  std::vector<Eigen::Vector3d> markers;
  while (static_cast<int>(markers.size()) < count) {
    const Eigen::Vector3d marker(random.uniform(-kHalfWidth, kHalfWidth),
                                 random.uniform(-kHalfWidth, kHalfWidth), kMarkerHeight);
    if (std::all_of(markers.begin(), markers.end(),
                    [&](const auto& other) { return (other - marker).norm() >= kClosestMarkers; }))
      markers.push_back(marker);
  }
  return markers;
}

/// Three balls almost on a line are no layout that anybody would build.
bool spansPlane(const std::vector<Eigen::Vector3d>& markers) {
  const Eigen::Vector3d along = markers[1] - markers[0];
  return std::any_of(markers.begin() + 2, markers.end(), [&](const Eigen::Vector3d& marker) {
    return along.cross(marker - markers[0]).norm() >= kLeastParallelogram;
  });
}

MarkerLayout randomLayout(Random& random, int count) {
  if (count == kSquare) return randomSquare(random);
  std::vector<Eigen::Vector3d> markers;
  do markers = randomMarkers(random, count);
  while (!spansPlane(markers));
  return MarkerLayout(markers, kMarkerRadius);
}

/// From 2.3 to 3.2 m away at 30 to 50 degrees of elevation, turned towards the helicopter but for some
/// centimetres, a little rolled.
RigidTransform randomCamera(Random& random) {
  const double azimuth = random.uniform(-kPi, kPi);
  const double elevation = toRadians(random.uniform(30.0, 50.0));
  const Eigen::Vector3d centre =
      random.uniform(2.3, 3.2) * Eigen::Vector3d(std::cos(elevation) * std::cos(azimuth),
                                                 std::cos(elevation) * std::sin(azimuth),
                                                 std::sin(elevation));
  const Eigen::Vector3d target(0.05 * random.normal(), 0.05 * random.normal(), 0.0);
  const Eigen::Vector3d forward = (target - centre).normalized();
  const Eigen::Vector3d right = forward.cross(Eigen::Vector3d::UnitZ()).normalized();
  Eigen::Matrix3d camera_from_world;
  camera_from_world << right.transpose(), forward.cross(right).transpose(), forward.transpose();
  RigidTransform camera;
  camera.rotation =
      (expSO3({0, 0, random.uniform(-0.3, 0.3)}) * Eigen::Quaterniond(camera_from_world)).normalized();
  camera.translation = -(camera.rotation * centre);
  return camera;
}

RigidTransform roughGuess(const RigidTransform& camera_from_world, Random& random) {
  Vector6d error;
  error << toRadians(15.0) * randomDirection(random), 0.4 * randomDirection(random);
  return perturbCamera(camera_from_world, error);
}

Labelling randomOrder(Random& random, int markers) {
  Labelling order;
  order.count = markers;
  const auto n = static_cast<std::size_t>(markers);
  for (std::size_t k = 0; k < n; ++k) order.marker[k] = static_cast<std::uint8_t>(k);
  for (std::size_t k = n - 1; k > 0; --k) {
    const double other = random.uniform(0.0, static_cast<double>(k) + 1.0);
    std::swap(order.marker[k], order.marker[static_cast<std::size_t>(other)]);
  }
  return order;
}

}  // namespace

CameraModel randomViewCamera() {
  return CameraModel(640, 480, 567.6, 567.6, 319.5, 239.5);
}

RandomView randomView(Random& random, int markers) {
  RandomView view;
  view.layout = randomLayout(random, markers);
  const RigidTransform camera_from_world = randomCamera(random);
  view.guess = roughGuess(camera_from_world, random);
  view.truth = randomOrder(random, markers);
  for (std::size_t k = 0; k < static_cast<std::size_t>(markers); ++k) {
    const Eigen::Vector3d marker = view.layout.inBody(MarkerId{view.truth.marker[k]});
    view.frame.pixels[k] = *randomViewCamera().project(camera_from_world * marker) +
                           kSigmaPx * Eigen::Vector2d(random.normal(), random.normal());
  }
  return view;
}

}  // namespace helical
