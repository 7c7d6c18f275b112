#include "ui/scene.h"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkCameraPass.h>
#include <vtkLightsPass.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkOpaquePass.h>
#include <vtkOpenGLRenderer.h>
#include <vtkOverlayPass.h>
#include <vtkProperty.h>
#include <vtkRenderPassCollection.h>
#include <vtkRenderer.h>
#include <vtkSequencePass.h>
#include <vtkTransform.h>
#include <vtkTranslucentPass.h>

#include <algorithm>
#include <cmath>

#include "engine/geometry/rotation.h"
#include "ui/scene_cameras.h"
#include "ui/scene_helicopter.h"
#include "ui/scene_plan.h"
#include "ui/scene_polyline.h"
#include "ui/scene_shapes.h"
#include "ui/theme.h"

namespace helical {
namespace {

using Eigen::Vector3d;
using shapes::box;
using shapes::merged;
using shapes::Mesh;

constexpr double kGridReach = 6.0;

Mesh gridLines(int step_from, bool major) {
  std::vector<Vector3d> points;
  constexpr int kLines = static_cast<int>(kGridReach / 0.25);
  for (int i = -kLines; i <= kLines; i += step_from) {
    if (!major && i % 4 == 0) continue;
    const double s = 0.25 * i;
    points.insert(points.end(),
                  {{s, -kGridReach, 0}, {s, kGridReach, 0}, {-kGridReach, s, 0}, {kGridReach, s, 0}});
  }
  return shapes::segments(points);
}

}  // namespace

Scene::Scene(const SceneSetup& setup)
    : renderer_(vtkSmartPointer<vtkRenderer>::New()),
      floor_(vtkSmartPointer<vtkTransform>::New()),
      set_point_(vtkSmartPointer<vtkTransform>::New()) {
  renderer_->SetBackground(0.035, 0.046, 0.061);
  renderer_->SetBackground2(0.085, 0.110, 0.146);
  renderer_->GradientBackgroundOn();
  renderer_->GetActiveCamera()->SetViewAngle(toDegrees(0.61));
  buildPasses();
  buildFloor(setup);
  helicopter_ = std::make_unique<SceneHelicopter>(setup, *renderer_);
  cameras_ = std::make_unique<SceneCameras>(setup, *renderer_);
  for (const SceneCamera& camera : setup.cameras) camera_colors_.push_back(camera.color);
  buildFence(setup);
  plan_ = std::make_unique<ScenePlan>(*renderer_);
  buildLines();
}

Scene::~Scene() = default;

vtkRenderer* Scene::renderer() const {
  return renderer_;
}

void Scene::buildPasses() {
  // VTK's default order-independent translucency costs half of the frame on a software renderer.
  vtkNew<vtkLightsPass> lights;
  vtkNew<vtkOpaquePass> opaque;
  vtkNew<vtkTranslucentPass> translucent;
  vtkNew<vtkOverlayPass> overlay;
  vtkNew<vtkRenderPassCollection> passes;
  passes->AddItem(lights);
  passes->AddItem(opaque);
  passes->AddItem(translucent);
  passes->AddItem(overlay);
  vtkNew<vtkSequencePass> sequence;
  sequence->SetPasses(passes);
  vtkNew<vtkCameraPass> camera;
  camera->SetDelegatePass(sequence);
  vtkOpenGLRenderer::SafeDownCast(renderer_)->SetPass(camera);
}

void Scene::add(const vtkSmartPointer<vtkActor>& actor) {
  renderer_->AddActor(actor);
}

void Scene::buildFloor(const SceneSetup& setup) {
  const double pad = 1.5 * setup.helicopter.rotor_radius;
  const std::vector<vtkSmartPointer<vtkActor>> actors{
      shapes::flat(gridLines(1, false), QColor(0x18, 0x20, 0x2a)),
      shapes::flat(gridLines(4, true), QColor(0x2b, 0x36, 0x44)),
      shapes::flat(shapes::ring(0.001, 0.0, pad), QColor(0x16, 0x1e, 0x28)),
      shapes::flat(shapes::ring(0.002, 0.94 * pad, pad), QColor(0x8a, 0x98, 0xa8)),
      // The letter H, its legs along the nose's direction.
      shapes::flat(merged({box({0, 0.32 * pad, 0.002}, {pad, 0.09 * pad, 0.001}),
                           box({0, -0.32 * pad, 0.002}, {pad, 0.09 * pad, 0.001}),
                           box({0, 0, 0.002}, {0.09 * pad, 0.64 * pad, 0.001})}),
                   QColor(0x6d, 0x7b, 0x8b)),
      // World axes, x red, y green, z blue by custom.
      shapes::flat(shapes::segments({{0, 0, 0.004}, {2.0 * pad, 0, 0.004}}), QColor(0xd0, 0x6a, 0x6a), 1.0,
                   2.0),
      shapes::flat(shapes::segments({{0, 0, 0.004}, {0, 2.0 * pad, 0.004}}), QColor(0x6a, 0xc0, 0x7a), 1.0,
                   2.0)};
  for (const auto& actor : actors) {
    actor->SetUserTransform(floor_);
    add(actor);
  }
}

void Scene::buildFence(const SceneSetup& setup) {
  std::vector<Vector3d> lines = shapes::circle(setup.fence_radius, 0.003);
  const std::vector<Vector3d> top = shapes::circle(setup.fence_radius, setup.fence_height);
  lines.insert(lines.end(), top.begin(), top.end());
  for (int i = 0; i < 12; ++i) {
    const Vector3d foot(setup.fence_radius * std::cos(kPi * i / 6.0),
                        setup.fence_radius * std::sin(kPi * i / 6.0), 0.003);
    lines.insert(lines.end(), {foot, Vector3d(foot.x(), foot.y(), setup.fence_height)});
  }
  fence_ = shapes::flat(shapes::segments(shapes::dashed(lines, 0.02)), theme::on_dark::kCaution, 0.12);
  fence_->SetUserTransform(floor_);
  if (setup.fence_radius > 0.0) add(fence_);
}

void Scene::buildLines() {
  trail_ = std::make_unique<ScenePolyline>();
  trail_->actor->GetProperty()->SetLineWidth(2.0F);
  rays_ = std::make_unique<ScenePolyline>();
  drop_line_ = std::make_unique<ScenePolyline>();
  particles_ = std::make_unique<ScenePolyline>();
  particles_->actor->GetProperty()->SetPointSize(3.0F);
  coverage_ = std::make_unique<ScenePolyline>();
  coverage_->actor->GetProperty()->SetLineWidth(1.2F);
  for (const ScenePolyline* line :
       {coverage_.get(), trail_.get(), rays_.get(), drop_line_.get(), particles_.get()})
    add(line->actor);

  constexpr double kArm = 0.06;
  set_point_actor_ = shapes::flat(
      shapes::segments(
          {{-kArm, 0, 0}, {kArm, 0, 0}, {0, -kArm, 0}, {0, kArm, 0}, {0, 0, -kArm}, {0, 0, kArm}}),
      theme::on_dark::kCaution, 0.9, 1.5);
  set_point_actor_->SetUserTransform(set_point_);
  add(set_point_actor_);
}

void Scene::show(const SceneFrame& frame) {
  floor_->Identity();
  floor_->Translate(0.0, 0.0, frame.floor_height);
  helicopter_->show(frame);
  cameras_->show(frame);
  plan_->show(frame);
  showParticles(frame);
  showCoverage(frame);
  fence_->GetProperty()->SetOpacity(0.12 + 0.7 * frame.fence_nearness);
  showTrail(frame);
  showRays(frame);
  showReference(frame);
  vtkCamera* camera = renderer_->GetActiveCamera();
  camera->SetPosition(frame.eye.data());
  camera->SetFocalPoint(frame.focus.data());
  camera->SetViewUp(frame.up.data());
  camera->SetViewAngle(toDegrees(frame.field_of_view));
  camera->SetClippingRange(0.1, 80.0);
}

void Scene::showCoverage(const SceneFrame& frame) {
  if (frame.coverage == shown_coverage_) return;
  shown_coverage_ = frame.coverage;
  coverage_->clear();
  for (std::size_t i = 0; frame.coverage && i + 1 < frame.coverage->size(); i += 2) {
    const vtkIdType from = coverage_->add((*frame.coverage)[i], theme::on_dark::kHealthy, 80);
    coverage_->line(from, coverage_->add((*frame.coverage)[i + 1], theme::on_dark::kHealthy, 80));
  }
  coverage_->finish();
}

void Scene::showParticles(const SceneFrame& frame) {
  particles_->clear();
  for (const SceneParticle& particle : frame.particles) {
    const QColor& color = camera_colors_[static_cast<std::size_t>(particle.camera)];
    const auto blend = [&](int channel) {
      return static_cast<int>(channel + particle.weight * (255 - channel));
    };
    const QColor shade(blend(color.red()), blend(color.green()), blend(color.blue()));
    particles_->dot(particles_->add(particle.position, shade, static_cast<int>(90 + 165 * particle.weight)));
  }
  particles_->finish();
}

void Scene::showTrail(const SceneFrame& frame) {
  trail_->clear();
  const std::size_t count = frame.trail.size();
  for (std::size_t i = 0; i < count; ++i) {
    const auto age = static_cast<double>(i + 1) / static_cast<double>(count);
    const vtkIdType id =
        trail_->add(frame.trail[i], theme::on_dark::kActive, static_cast<int>(220 * age * age));
    if (i > 0) trail_->line(id - 1, id);
  }
  trail_->finish();
}

void Scene::showRays(const SceneFrame& frame) {
  rays_->clear();
  for (const SceneRay& ray : frame.rays) {
    const QColor& color = camera_colors_[static_cast<std::size_t>(ray.camera)];
    const vtkIdType from = rays_->add(ray.from, color, 110);
    rays_->line(from, rays_->add(ray.to, color, 60));
  }
  rays_->finish();
}

void Scene::showReference(const SceneFrame& frame) {
  set_point_actor_->SetVisibility(frame.has_set_point);
  set_point_->Identity();
  set_point_->Translate(frame.set_point.data());

  // A plumb line to the floor tells height and place, which perspective alone does not.
  drop_line_->clear();
  if (frame.presence == Presence::kTracked) {
    const Vector3d& top = frame.world_from_body.translation;
    const Vector3d foot(top.x(), top.y(), frame.floor_height);
    drop_line_->line(drop_line_->add(top, theme::on_dark::kText, 70),
                     drop_line_->add(foot, theme::on_dark::kText, 110));
  }
  drop_line_->finish();
}

SceneProjection Scene::projection(const QSizeF& size) const {
  vtkMatrix4x4* matrix = renderer_->GetActiveCamera()->GetCompositeProjectionTransformMatrix(
      size.width() / std::max(1.0, size.height()), -1.0, 1.0);
  SceneProjection result;
  result.size = size;
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column)
      result.clip_from_world(row, column) = matrix->GetElement(row, column);
  return result;
}

std::vector<SceneLabel> Scene::labels(const SceneFrame& frame, const SceneProjection& projection) const {
  std::vector<SceneLabel> labels;
  for (std::size_t i = 0; i < frame.cameras.size(); ++i) {
    if (!frame.cameras[i].known) continue;
    const Vector3d above = frame.cameras[i].camera_from_world.inverseTranslation() + Vector3d(0, 0, 0.14);
    const auto position = projection.toWidget(above);
    if (position) labels.push_back({*position, static_cast<int>(i), frame.cameras[i].in_use});
  }
  return labels;
}

}  // namespace helical
