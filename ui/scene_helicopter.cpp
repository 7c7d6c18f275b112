#include "ui/scene_helicopter.h"

#include <vtkActor.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkTransform.h>

#include "engine/geometry/rotation.h"
#include "ui/scene_shapes.h"

namespace helical {
namespace {

using Eigen::Vector3d;
using shapes::box;
using shapes::ellipsoid;
using shapes::merged;
using shapes::Mesh;
using shapes::rod;

const QColor kShell(0xd8, 0xdf, 0xe8);
const QColor kGlass(0x1c, 0x33, 0x4a);
const QColor kMetal(0x74, 0x80, 0x8e);
const QColor kBlade(0xb4, 0xc0, 0xce);
const QColor kDisc(0x6f, 0xb8, 0xe8);
const QColor kBall(0x35, 0xe0, 0x58);

}  // namespace

SceneHelicopter::SceneHelicopter(const SceneSetup& setup, vtkRenderer& renderer)
    : renderer_(renderer),
      body_(vtkSmartPointer<vtkTransform>::New()),
      upper_rotor_(vtkSmartPointer<vtkTransform>::New()),
      lower_rotor_(vtkSmartPointer<vtkTransform>::New()) {
  buildBody(setup);
  buildRotors(setup);
}

void SceneHelicopter::add(const vtkSmartPointer<vtkActor>& actor, vtkTransform* transform) {
  actor->SetUserTransform(transform);
  actors_.push_back(actor);
  renderer_.AddActor(actor);
}

void SceneHelicopter::buildBody(const SceneSetup& setup) {
  const double ground = -setup.helicopter.standing_height;
  const double top = setup.helicopter.upper.height;
  add(shapes::solid(merged({ellipsoid({-0.005, 0, 0.004}, {0.075, 0.036, 0.034}),
                            ellipsoid({-0.02, 0, 0.035}, {0.045, 0.022, 0.022}),
                            rod({-0.05, 0, 0.012}, {-0.255, 0, 0.030}, 0.013, 0.006),
                            box({-0.245, 0, 0.050}, {0.036, 0.004, 0.070}),
                            box({-0.215, 0, 0.028}, {0.026, 0.090, 0.003})}),
                    kShell),
      body_);
  add(shapes::solid(merged({ellipsoid({0.040, 0, 0.004}, {0.048, 0.0345, 0.033})}), kGlass, 0.9), body_);
  std::vector<Mesh> metal{rod({0, 0, 0.04}, {0, 0, top + 0.03}, 0.005, 0.004)};
  for (const double side : {0.055, -0.055}) {
    metal.push_back(rod({0.095, side, ground + 0.004}, {-0.085, side, ground + 0.004}, 0.004, 0.004));
    metal.push_back(ellipsoid({0.095, side, ground + 0.004}, {0.004, 0.004, 0.004}, 10));
    for (const double x : {0.045, -0.045})
      metal.push_back(rod({x, 0.5 * side, -0.02}, {x, side, ground + 0.004}, 0.003, 0.003));
  }
  std::vector<Mesh> balls;
  const double r = setup.markers.radius();
  for (const Vector3d& marker : setup.markers.all()) {
    metal.push_back(rod({0.2 * marker.x(), 0.12 * marker.y(), -0.015}, marker, 0.002, 0.002));
    balls.push_back(ellipsoid(marker, {r, r, r}, 20));
  }
  add(shapes::solid(merged(metal), kMetal), body_);
  add(shapes::solid(merged(balls), kBall, 0.5), body_);
}

void SceneHelicopter::buildRotors(const SceneSetup& setup) {
  const HelicopterParameters& h = setup.helicopter;
  upper_rotor_->SetInput(body_);
  lower_rotor_->SetInput(body_);
  const double bar = h.upper.height + 0.028;
  add(shapes::solid(merged({box({0, 0, h.upper.height}, {2.0 * h.rotor_radius, 0.024, 0.0025}),
                            rod({0, -0.09, bar}, {0, 0.09, bar}, 0.0018, 0.0018),
                            ellipsoid({0, 0.09, bar}, {0.006, 0.010, 0.006}, 12),
                            ellipsoid({0, -0.09, bar}, {0.006, 0.010, 0.006}, 12)}),
                    kBlade),
      upper_rotor_);
  add(shapes::solid(merged({box({0, 0, h.lower.height}, {2.0 * h.rotor_radius, 0.024, 0.0025})}), kBlade),
      lower_rotor_);
  discs_ = {shapes::flat(shapes::ring(h.upper.height, 0.0, h.rotor_radius), kDisc),
            shapes::flat(shapes::ring(h.lower.height, 0.0, h.rotor_radius), kDisc)};
  for (const auto& disc : discs_) add(disc, body_);
}

void SceneHelicopter::show(const SceneFrame& frame) {
  body_->SetMatrix(shapes::matrixOf(frame.world_from_body).data());
  upper_rotor_->Identity();
  upper_rotor_->RotateZ(toDegrees(frame.upper_angle));
  lower_rotor_->Identity();
  lower_rotor_->RotateZ(toDegrees(frame.lower_angle));
  const double opacity = frame.presence == Presence::kTracked ? 1.0 : 0.3;
  for (const auto& actor : actors_) {
    actor->SetVisibility(frame.presence != Presence::kAbsent);
    actor->GetProperty()->SetOpacity(opacity);
  }
  discs_[0]->GetProperty()->SetOpacity(0.22 * opacity * frame.upper_demand);
  discs_[1]->GetProperty()->SetOpacity(0.22 * opacity * frame.lower_demand);
}

}  // namespace helical
