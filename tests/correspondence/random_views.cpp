#include "tests/correspondence/random_views.h"

#include <algorithm>
#include <cmath>

#include "engine/geometry/camera_perturbation.h"

namespace helical {
namespace {

Eigen::Vector3d direction(Random& random) {
  return Eigen::Vector3d(random.normal(), random.normal(), random.normal()).normalized();
}

MarkerLayout randomLayout(Random& random, int count) {
  std::vector<Eigen::Vector3d> markers;
  while (static_cast<int>(markers.size()) < count) {
    // The first three span a triangle of some extent.
    const double corner = 2.0 * kPi / 3.0 * static_cast<double>(markers.size());
    Eigen::Vector3d marker(random.uniform(-0.17, 0.17), random.uniform(-0.17, 0.17), -0.05);
    if (markers.size() < 3)
      marker = {0.13 * std::cos(corner) + random.uniform(-0.04, 0.04),
                0.13 * std::sin(corner) + random.uniform(-0.04, 0.04), -0.05};
    if (std::all_of(markers.begin(), markers.end(),
                    [&](const auto& other) { return (other - marker).norm() > 0.025; }))
      markers.push_back(marker);
  }
  return MarkerLayout(markers, 0.012);
}

RigidTransform randomCamera(Random& random) {
  const double azimuth = random.uniform(-kPi, kPi), elevation = toRadians(random.uniform(30.0, 50.0));
  const Eigen::Vector3d centre =
      Eigen::Vector3d(0, 0, 0.3) +
      random.uniform(2.3, 3.2) * Eigen::Vector3d(std::cos(elevation) * std::cos(azimuth),
                                                 std::cos(elevation) * std::sin(azimuth),
                                                 std::sin(elevation));
  const Eigen::Vector3d forward = (Eigen::Vector3d(0, 0, 0.3) - centre).normalized();
  const Eigen::Vector3d right = forward.cross(Eigen::Vector3d::UnitZ()).normalized();
  Eigen::Matrix3d axes;
  axes << right.transpose(), forward.cross(right).transpose(), forward.transpose();
  const Eigen::Quaterniond rotation(axes);
  return {rotation, -(rotation * centre)};
}

}  // namespace

CameraModel viewCamera() {
  return CameraModel(640, 480, 567.6, 567.6, 319.5, 239.5, {-0.05, 0.01, 0.0004, -0.0003, 0.0});
}

RigidTransform randomHover(Random& random) {
  const Eigen::Quaterniond heading = expSO3({0, 0, random.uniform(-kPi, kPi)});
  const Eigen::Quaterniond tilt = expSO3({0.05 * random.normal(), 0.05 * random.normal(), 0});
  return {heading * tilt,
          {random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1), 0.3 + random.uniform(-0.2, 0.2)}};
}

RandomView randomView(Random& random, int markers, double sigma_px) {
  RandomView view;
  view.layout = randomLayout(random, markers);
  for (const auto& marker : view.layout.all()) view.in_plane.emplace_back(marker.head<2>());
  view.camera_from_world = randomCamera(random);
  view.world_from_body = randomHover(random);
  view.truth.count = markers;
  for (std::size_t k = 0; k < static_cast<std::size_t>(markers); ++k)
    view.truth.marker[k] = static_cast<std::uint8_t>(k);
  for (std::size_t k = static_cast<std::size_t>(markers) - 1; k > 0; --k)
    std::swap(view.truth.marker[k],
              view.truth.marker[static_cast<std::size_t>(random.uniform(0.0, static_cast<double>(k) + 1.0))]);
  const LabellingFrame frame = frameOf(view, view.world_from_body, sigma_px, random);
  view.pixels.assign(frame.pixels.begin(), frame.pixels.begin() + markers);
  return view;
}

LabellingFrame frameOf(const RandomView& view, const RigidTransform& world_from_body, double sigma_px,
                       Random& random) {
  LabellingFrame frame;
  frame.world_from_body = world_from_body;
  for (std::size_t k = 0; k < static_cast<std::size_t>(view.truth.count); ++k) {
    const Eigen::Vector3d marker = view.layout.inBody(MarkerId{view.truth.marker[k]});
    frame.pixels[k] = *viewCamera().project(view.camera_from_world * (world_from_body * marker)) +
                      sigma_px * Eigen::Vector2d(random.normal(), random.normal());
  }
  return frame;
}

RigidTransform guessOf(const RandomView& view, double angle, double distance, Random& random) {
  Vector6d error;
  error << angle * direction(random), distance * direction(random);
  return perturbCamera(view.camera_from_world, error);
}

}  // namespace helical
