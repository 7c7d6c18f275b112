#include "ui/scene_shapes.h"

#include <vtkActor.h>
#include <vtkAppendPolyData.h>
#include <vtkCellArray.h>
#include <vtkCubeSource.h>
#include <vtkDiskSource.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkPolyDataNormals.h>
#include <vtkProperty.h>
#include <vtkSphereSource.h>
#include <vtkTransform.h>
#include <vtkTransformPolyDataFilter.h>

#include <QColor>
#include <cmath>

#include "engine/geometry/rotation.h"

namespace helical::shapes {
namespace {

constexpr int kRodSides = 14;

Mesh transformed(vtkAlgorithmOutput* source, vtkTransform* transform) {
  vtkNew<vtkTransformPolyDataFilter> filter;
  filter->SetInputConnection(source);
  filter->SetTransform(transform);
  filter->Update();
  return filter->GetOutput();
}

vtkSmartPointer<vtkActor> actorOf(const Mesh& mesh, const QColor& color) {
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(mesh);
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(color.redF(), color.greenF(), color.blueF());
  return actor;
}

}  // namespace

Mesh ellipsoid(const Eigen::Vector3d& center, const Eigen::Vector3d& radii, int resolution) {
  vtkNew<vtkSphereSource> sphere;
  sphere->SetRadius(1.0);
  sphere->SetThetaResolution(resolution);
  sphere->SetPhiResolution(resolution);
  vtkNew<vtkTransform> place;
  place->Translate(center.data());
  place->Scale(radii.data());
  return transformed(sphere->GetOutputPort(), place);
}

Mesh rod(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double from_radius, double to_radius) {
  const Eigen::Vector3d along = (to - from).normalized();
  const Eigen::Vector3d side = along.unitOrthogonal();
  const Eigen::Vector3d other = along.cross(side);
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> faces;
  for (int i = 0; i < kRodSides; ++i) {
    const double angle = 2.0 * kPi * i / kRodSides;
    const Eigen::Vector3d outward = std::cos(angle) * side + std::sin(angle) * other;
    points->InsertNextPoint(Eigen::Vector3d(from + from_radius * outward).data());
    points->InsertNextPoint(Eigen::Vector3d(to + to_radius * outward).data());
    const vtkIdType next = 2 * ((i + 1) % kRodSides);
    const vtkIdType face[4] = {2 * i, 2 * i + 1, next + 1, next};
    faces->InsertNextCell(4, face);
  }
  auto mesh = Mesh::New();
  mesh->SetPoints(points);
  mesh->SetPolys(faces);
  return mesh;
}

Mesh box(const Eigen::Vector3d& center, const Eigen::Vector3d& size) {
  vtkNew<vtkCubeSource> cube;
  cube->SetCenter(center.x(), center.y(), center.z());
  cube->SetXLength(size.x());
  cube->SetYLength(size.y());
  cube->SetZLength(size.z());
  cube->Update();
  return cube->GetOutput();
}

Mesh ring(double height, double inner_radius, double outer_radius) {
  vtkNew<vtkDiskSource> disk;
  disk->SetInnerRadius(inner_radius);
  disk->SetOuterRadius(outer_radius);
  disk->SetCircumferentialResolution(64);
  vtkNew<vtkTransform> place;
  place->Translate(0.0, 0.0, height);
  return transformed(disk->GetOutputPort(), place);
}

Mesh merged(const std::vector<Mesh>& parts) {
  vtkNew<vtkAppendPolyData> append;
  for (const Mesh& part : parts) append->AddInputData(part);
  vtkNew<vtkPolyDataNormals> normals;
  normals->SetInputConnection(append->GetOutputPort());
  normals->SetFeatureAngle(40.0);
  normals->Update();
  return normals->GetOutput();
}

Mesh segments(const std::vector<Eigen::Vector3d>& points) {
  vtkNew<vtkPoints> ends;
  vtkNew<vtkCellArray> lines;
  for (std::size_t i = 0; i + 1 < points.size(); i += 2) {
    const vtkIdType line[2] = {ends->InsertNextPoint(points[i].data()),
                               ends->InsertNextPoint(points[i + 1].data())};
    lines->InsertNextCell(2, line);
  }
  auto mesh = Mesh::New();
  mesh->SetPoints(ends);
  mesh->SetLines(lines);
  return mesh;
}

vtkSmartPointer<vtkActor> solid(const Mesh& mesh, const QColor& color, double shine) {
  auto actor = actorOf(mesh, color);
  actor->GetProperty()->SetAmbient(0.2);
  actor->GetProperty()->SetDiffuse(0.85);
  actor->GetProperty()->SetSpecular(shine);
  actor->GetProperty()->SetSpecularPower(40.0);
  return actor;
}

vtkSmartPointer<vtkActor> flat(const Mesh& mesh, const QColor& color, double opacity, double width) {
  auto actor = actorOf(mesh, color);
  actor->GetProperty()->LightingOff();
  actor->GetProperty()->SetOpacity(opacity);
  actor->GetProperty()->SetLineWidth(static_cast<float>(width));
  return actor;
}

/// The same segments, each in dashes.
std::vector<Eigen::Vector3d> dashed(const std::vector<Eigen::Vector3d>& segments, double dash) {
  std::vector<Eigen::Vector3d> result;
  for (std::size_t i = 0; i + 1 < segments.size(); i += 2) {
    const Eigen::Vector3d along = segments[i + 1] - segments[i];
    const int pieces = std::max(1, static_cast<int>(along.norm() / (2.0 * dash)));
    for (int k = 0; k < pieces; ++k)
      result.insert(result.end(),
                    {segments[i] + along * (k + 0.0) / pieces, segments[i] + along * (k + 0.5) / pieces});
  }
  return result;
}

std::vector<Eigen::Vector3d> circle(double radius, double height) {
  constexpr int kSides = 96;
  std::vector<Eigen::Vector3d> segments;
  for (int i = 0; i < kSides; ++i)
    for (const int end : {i, i + 1})
      segments.emplace_back(radius * std::cos(2.0 * kPi * end / kSides),
                            radius * std::sin(2.0 * kPi * end / kSides), height);
  return segments;
}

/// Row-major 4x4, as vtkTransform takes it.
std::array<double, 16> matrixOf(const RigidTransform& transform) {
  const Eigen::Matrix3d r = transform.rotation.toRotationMatrix();
  const Eigen::Vector3d& t = transform.translation;
  return {r(0, 0), r(0, 1), r(0, 2), t.x(), r(1, 0), r(1, 1), r(1, 2), t.y(),
          r(2, 0), r(2, 1), r(2, 2), t.z(), 0.0,     0.0,     0.0,     1.0};
}

}  // namespace helical::shapes
