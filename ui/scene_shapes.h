#pragma once

#include <vtkSmartPointer.h>

#include <Eigen/Core>
#include <array>
#include <vector>

#include "engine/geometry/rigid_transform.h"

class vtkActor;
class vtkPolyData;
class QColor;

namespace helical::shapes {

using Mesh = vtkSmartPointer<vtkPolyData>;

/// Meshes with normals, lengths in metres.
Mesh ellipsoid(const Eigen::Vector3d& center, const Eigen::Vector3d& radii, int resolution = 28);
Mesh rod(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double from_radius, double to_radius);
Mesh box(const Eigen::Vector3d& center, const Eigen::Vector3d& size);
/// Flat ring about the z axis.
Mesh ring(double height, double inner_radius, double outer_radius);
Mesh merged(const std::vector<Mesh>& parts);

/// Straight lines, two points each.
Mesh segments(const std::vector<Eigen::Vector3d>& points);

/// The same segments, each in dashes.
std::vector<Eigen::Vector3d> dashed(const std::vector<Eigen::Vector3d>& segments, double dash);
/// As segments, about the z axis.
std::vector<Eigen::Vector3d> circle(double radius, double height);

/// Row-major 4x4, as vtkTransform takes it.
std::array<double, 16> matrixOf(const RigidTransform& transform);

/// An actor for shaded surfaces, and one for lines and flat colours.
vtkSmartPointer<vtkActor> solid(const Mesh& mesh, const QColor& color, double shine = 0.25);
vtkSmartPointer<vtkActor> flat(const Mesh& mesh, const QColor& color, double opacity = 1.0,
                               double width = 1.0);

}  // namespace helical::shapes
