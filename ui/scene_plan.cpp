#include "ui/scene_plan.h"

#include <vtkActor.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>

#include "ui/scene_polyline.h"
#include "ui/scene_shapes.h"
#include "ui/theme.h"

namespace helical {
namespace {

using Eigen::Vector3d;

constexpr double kBall = 0.02;        // m
constexpr double kMeantBall = 0.034;  // m

}  // namespace

ScenePlan::ScenePlan(vtkRenderer& renderer) : renderer_(renderer), lines_(std::make_unique<ScenePolyline>()) {
  renderer_.AddActor(lines_->actor);
}

ScenePlan::~ScenePlan() = default;

void ScenePlan::show(const SceneFrame& frame) {
  while (balls_.size() < frame.plan.size()) {
    balls_.push_back(
        shapes::solid(shapes::ellipsoid(Vector3d::Zero(), Vector3d::Ones(), 14), theme::on_dark::kCaution));
    renderer_.AddActor(balls_.back());
  }
  const QColor color = frame.plan_is_draft ? theme::on_dark::kActive : theme::on_dark::kCaution;
  for (std::size_t i = 0; i < balls_.size(); ++i) {
    vtkActor& ball = *balls_[i];
    ball.SetVisibility(i < frame.plan.size());
    if (i >= frame.plan.size()) continue;
    ball.SetPosition(frame.plan[i].x(), frame.plan[i].y(), frame.plan[i].z());
    ball.SetScale(static_cast<int>(i) == frame.meant_waypoint ? kMeantBall : kBall);
    ball.GetProperty()->SetColor(color.redF(), color.greenF(), color.blueF());
    ball.GetProperty()->SetOpacity(static_cast<int>(i) == frame.meant_waypoint ? 1.0 : 0.7);
  }
  lines_->clear();
  std::vector<Vector3d> legs;
  for (std::size_t i = 1; i < frame.plan.size(); ++i)
    legs.insert(legs.end(), {frame.plan[i - 1], frame.plan[i]});
  legs = shapes::dashed(legs, 0.02);
  for (std::size_t i = 0; i + 1 < legs.size(); i += 2) {
    const vtkIdType from = lines_->add(legs[i], color, 140);
    lines_->line(from, lines_->add(legs[i + 1], color, 140));
  }
  for (const Vector3d& waypoint : frame.plan) {
    const vtkIdType top = lines_->add(waypoint, color, 90);
    lines_->line(top, lines_->add({waypoint.x(), waypoint.y(), frame.floor_height + 0.003}, color, 30));
  }
  lines_->finish();
}

}  // namespace helical
