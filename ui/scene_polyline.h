#pragma once

#include <vtkActor.h>
#include <vtkCellArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkSmartPointer.h>
#include <vtkUnsignedCharArray.h>

#include <Eigen/Core>
#include <QColor>

namespace helical {

/// Lines and dots whose points and colours change with every frame.
struct ScenePolyline {
  ScenePolyline() {
    colors->SetNumberOfComponents(4);
    mesh->SetPoints(points);
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputData(mesh);
    actor->SetMapper(mapper);
    actor->GetProperty()->LightingOff();
    // Alpha comes per vertex, which VTK does not look at when it sorts actors into passes.
    actor->ForceTranslucentOn();
  }
  void clear() {
    points->Reset();
    colors->Reset();
    cells = vtkSmartPointer<vtkCellArray>::New();
    dots = vtkSmartPointer<vtkCellArray>::New();
  }
  vtkIdType add(const Eigen::Vector3d& point, const QColor& color, int alpha) {
    colors->InsertNextTuple4(color.red(), color.green(), color.blue(), alpha);
    return points->InsertNextPoint(point.data());
  }
  void line(vtkIdType from, vtkIdType to) {
    const vtkIdType ends[2] = {from, to};
    cells->InsertNextCell(2, ends);
  }
  void dot(vtkIdType at) { dots->InsertNextCell(1, &at); }
  void finish() {
    mesh->SetLines(cells);
    mesh->SetVerts(dots);
    mesh->GetPointData()->SetScalars(colors);
    points->Modified();
    colors->Modified();
    mesh->Modified();
    actor->SetVisibility(cells->GetNumberOfCells() + dots->GetNumberOfCells() > 0);
  }

  vtkSmartPointer<vtkPoints> points = vtkSmartPointer<vtkPoints>::New();
  vtkSmartPointer<vtkUnsignedCharArray> colors = vtkSmartPointer<vtkUnsignedCharArray>::New();
  vtkSmartPointer<vtkCellArray> cells = vtkSmartPointer<vtkCellArray>::New();
  vtkSmartPointer<vtkCellArray> dots = vtkSmartPointer<vtkCellArray>::New();
  vtkSmartPointer<vtkPolyData> mesh = vtkSmartPointer<vtkPolyData>::New();
  vtkSmartPointer<vtkActor> actor = vtkSmartPointer<vtkActor>::New();
};

}  // namespace helical
