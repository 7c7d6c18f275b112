#include "ui/scene_cameras.h"

#include <vtkActor.h>
#include <vtkCellArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkTransform.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/geometry/rotation.h"
#include "ui/scene_shapes.h"

namespace helical {
namespace {

using Eigen::Vector3d;
using shapes::box;
using shapes::merged;
using shapes::Mesh;
using shapes::rod;

constexpr double kSeenSpread = 0.02, kTellingSpread = 2.0;  // m
constexpr double kSeenAngle = toRadians(0.75), kTellingAngle = toRadians(50.0);

/// Three great circles of the unit sphere: lines hide nothing, and a filled ellipsoid costs a software
/// renderer most of its time.
std::vector<Vector3d> sphereRings() {
  std::vector<Vector3d> rings;
  for (const Vector3d& point : shapes::circle(1.0, 0.0)) rings.push_back(point);
  const std::size_t count = rings.size();
  for (std::size_t i = 0; i < count; ++i) rings.emplace_back(rings[i].x(), 0.0, rings[i].y());
  for (std::size_t i = 0; i < count; ++i) rings.emplace_back(0.0, rings[i].x(), rings[i].y());
  return rings;
}

/// Apex in the origin, rim of radius 1 at z = 1.
std::vector<Vector3d> unitCone() {
  std::vector<Vector3d> lines = shapes::circle(1.0, 1.0);
  const std::size_t count = lines.size();
  for (std::size_t i = 0; i < count; i += count / 8)
    lines.insert(lines.end(), {Vector3d::Zero(), Vector3d(lines[i])});
  return lines;
}

}  // namespace

SceneCameras::SceneCameras(const SceneSetup& setup, vtkRenderer& renderer) {
  for (const SceneCamera& camera : setup.cameras) {
    const Actors actors = build(camera);
    for (const auto& actor :
         {actors.body, actors.edges, actors.faces, actors.truth, actors.ellipsoid, actors.cone})
      renderer.AddActor(actor);
    cameras_.push_back(actors);
  }
}

SceneCameras::Actors SceneCameras::build(const SceneCamera& camera) const {
  const double w = camera.model.width() - 0.5, h = camera.model.height() - 0.5;
  std::array<Vector3d, 4> corners;
  const std::array<Eigen::Vector2d, 4> pixels{{{-0.5, -0.5}, {w, -0.5}, {w, h}, {-0.5, h}}};
  for (std::size_t i = 0; i < 4; ++i)
    corners[i] = kFrustumLength * camera.model.bearing(pixels[i]).homogeneous();

  std::vector<Vector3d> edges;
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> triangles;
  points->InsertNextPoint(0.0, 0.0, 0.0);
  for (std::size_t i = 0; i < 4; ++i) {
    const Vector3d& next = corners[(i + 1) % 4];
    edges.insert(edges.end(), {Vector3d::Zero(), corners[i], corners[i], next});
    points->InsertNextPoint(corners[i].data());
    const vtkIdType triangle[3] = {0, static_cast<vtkIdType>(1 + i), static_cast<vtkIdType>(1 + (i + 1) % 4)};
    triangles->InsertNextCell(3, triangle);
  }
  auto faces = Mesh::New();
  faces->SetPoints(points);
  faces->SetPolys(triangles);

  Actors actors;
  for (auto* transform :
       {&actors.world_from_camera, &actors.world_from_true_camera, &actors.spread, &actors.cone_shape})
    *transform = vtkSmartPointer<vtkTransform>::New();
  actors.body = shapes::solid(
      merged({box({0, 0, -0.07}, {0.075, 0.075, 0.10}), rod({0, 0, -0.02}, {0, 0, 0.03}, 0.03, 0.036)}),
      camera.color.darker(125));
  actors.edges = shapes::flat(shapes::segments(edges), camera.color);
  actors.faces = shapes::flat(faces, camera.color);
  for (const auto& actor : {actors.body, actors.edges, actors.faces})
    actor->SetUserTransform(actors.world_from_camera);
  actors.truth =
      shapes::flat(shapes::segments(shapes::dashed(edges, 0.012)), camera.color.lighter(140), 0.85, 1.4);
  actors.truth->SetUserTransform(actors.world_from_true_camera);
  actors.ellipsoid = shapes::flat(shapes::segments(sphereRings()), camera.color, 0.7);
  actors.ellipsoid->SetUserTransform(actors.spread);
  actors.cone = shapes::flat(shapes::segments(unitCone()), camera.color, 0.45);
  actors.cone_shape->SetInput(actors.world_from_camera);
  actors.cone->SetUserTransform(actors.cone_shape);
  return actors;
}

void SceneCameras::show(const SceneFrame& frame) {
  for (std::size_t i = 0; i < cameras_.size() && i < frame.cameras.size(); ++i) {
    const SceneCameraPose& pose = frame.cameras[i];
    const Actors& actors = cameras_[i];
    for (const auto& actor : {actors.body, actors.edges, actors.faces}) actor->SetVisibility(pose.known);
    actors.truth->SetVisibility(pose.has_truth);
    if (pose.has_truth)
      actors.world_from_true_camera->SetMatrix(
          shapes::matrixOf(pose.true_camera_from_world.inverse()).data());
    showSpread(actors, pose);
    if (!pose.known) continue;
    actors.world_from_camera->SetMatrix(shapes::matrixOf(pose.camera_from_world.inverse()).data());
    actors.body->GetProperty()->SetOpacity(pose.in_use ? 1.0 : 0.35);
    actors.edges->GetProperty()->SetOpacity(pose.in_use ? 0.75 : 0.25);
    actors.faces->GetProperty()->SetOpacity(pose.in_use ? 0.07 : 0.02);
  }
}

void SceneCameras::showSpread(const Actors& actors, const SceneCameraPose& pose) const {
  const bool shown = pose.known && pose.has_spread;
  // As thin as a line they look like one more line; as large as the room they say nothing.
  actors.ellipsoid->SetVisibility(shown && pose.spread_radii.maxCoeff() > kSeenSpread &&
                                  pose.spread_radii.maxCoeff() < kTellingSpread);
  actors.cone->SetVisibility(shown && pose.spread_angle > kSeenAngle && pose.spread_angle < kTellingAngle);
  if (!shown) return;
  const RigidTransform place{pose.spread_axes, pose.camera_from_world.inverseTranslation()};
  actors.spread->SetMatrix(shapes::matrixOf(place).data());
  actors.spread->Scale(pose.spread_radii.data());
  const double length = 1.6 * kFrustumLength,
               width = length * std::tan(std::min(pose.spread_angle, kTellingAngle));
  actors.cone_shape->Identity();
  actors.cone_shape->Scale(width, width, length);
}

}  // namespace helical
