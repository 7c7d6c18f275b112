#include "ui/scene.h"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkCameraPass.h>
#include <vtkCellArray.h>

#include <vtkLightsPass.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkOpaquePass.h>
#include <vtkOpenGLRenderer.h>
#include <vtkOverlayPass.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderPassCollection.h>
#include <vtkRenderer.h>
#include <vtkSequencePass.h>
#include <vtkTransform.h>
#include <vtkTranslucentPass.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cmath>

#include "engine/geometry/rotation.h"
#include "ui/scene_shapes.h"
#include "ui/theme.h"

namespace helical {
namespace {

using Eigen::Vector3d;
using shapes::box;
using shapes::ellipsoid;
using shapes::merged;
using shapes::Mesh;
using shapes::rod;

constexpr double kFrustumLength = 0.45;
constexpr double kGridReach = 6.0;
constexpr double kSeenSpread = 0.02, kTellingSpread = 2.0;  // m
constexpr double kSeenAngle = toRadians(0.75), kTellingAngle = toRadians(50.0);

const QColor kShell(0xd8, 0xdf, 0xe8);
const QColor kGlass(0x1c, 0x33, 0x4a);
const QColor kMetal(0x74, 0x80, 0x8e);
const QColor kBlade(0xb4, 0xc0, 0xce);
const QColor kDisc(0x6f, 0xb8, 0xe8);
const QColor kBall(0x35, 0xe0, 0x58);

/// Row-major 4x4, as vtkTransform takes it.
std::array<double, 16> matrixOf(const RigidTransform& transform) {
  const Eigen::Matrix3d r = transform.rotation.toRotationMatrix();
  const Vector3d& t = transform.translation;
  return {r(0, 0), r(0, 1), r(0, 2), t.x(), r(1, 0), r(1, 1), r(1, 2), t.y(),
          r(2, 0), r(2, 1), r(2, 2), t.z(), 0.0,     0.0,     0.0,     1.0};
}

/// The same segments, each in dashes.
std::vector<Vector3d> dashed(const std::vector<Vector3d>& segments, double dash) {
  std::vector<Vector3d> result;
  for (std::size_t i = 0; i + 1 < segments.size(); i += 2) {
    const Vector3d along = segments[i + 1] - segments[i];
    const int pieces = std::max(1, static_cast<int>(along.norm() / (2.0 * dash)));
    for (int k = 0; k < pieces; ++k)
      result.insert(result.end(),
                    {segments[i] + along * (k + 0.0) / pieces, segments[i] + along * (k + 0.5) / pieces});
  }
  return result;
}

std::vector<Vector3d> circle(double radius, double height) {
  constexpr int kSides = 96;
  std::vector<Vector3d> segments;
  for (int i = 0; i < kSides; ++i)
    for (const int end : {i, i + 1})
      segments.emplace_back(radius * std::cos(2.0 * kPi * end / kSides),
                            radius * std::sin(2.0 * kPi * end / kSides), height);
  return segments;
}

/// Three great circles of the unit sphere: lines hide nothing, and a filled ellipsoid costs a software
/// renderer most of its time.
std::vector<Vector3d> sphereRings() {
  std::vector<Vector3d> rings;
  for (const Vector3d& point : circle(1.0, 0.0)) rings.push_back(point);
  const std::size_t count = rings.size();
  for (std::size_t i = 0; i < count; ++i) rings.emplace_back(rings[i].x(), 0.0, rings[i].y());
  for (std::size_t i = 0; i < count; ++i) rings.emplace_back(0.0, rings[i].x(), rings[i].y());
  return rings;
}

/// Apex in the origin, rim of radius 1 at z = 1.
std::vector<Vector3d> unitCone() {
  std::vector<Vector3d> lines = circle(1.0, 1.0);
  const std::size_t count = lines.size();
  for (std::size_t i = 0; i < count; i += count / 8)
    lines.insert(lines.end(), {Vector3d::Zero(), Vector3d(lines[i])});
  return lines;
}

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

struct Scene::CameraActors {
  vtkSmartPointer<vtkTransform> world_from_camera = vtkSmartPointer<vtkTransform>::New();
  vtkSmartPointer<vtkActor> body;
  vtkSmartPointer<vtkActor> edges;
  vtkSmartPointer<vtkActor> faces;
  vtkSmartPointer<vtkTransform> world_from_true_camera = vtkSmartPointer<vtkTransform>::New();
  vtkSmartPointer<vtkActor> truth;
  vtkSmartPointer<vtkTransform> spread = vtkSmartPointer<vtkTransform>::New();
  vtkSmartPointer<vtkActor> ellipsoid;
  vtkSmartPointer<vtkTransform> cone_shape = vtkSmartPointer<vtkTransform>::New();
  vtkSmartPointer<vtkActor> cone;
};

/// Lines and dots whose points and colours change with every frame.
struct Scene::Polyline {
  Polyline() {
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
  vtkIdType add(const Vector3d& point, const QColor& color, int alpha) {
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

Scene::Scene(const SceneSetup& setup)
    : renderer_(vtkSmartPointer<vtkRenderer>::New()),
      floor_(vtkSmartPointer<vtkTransform>::New()),
      body_(vtkSmartPointer<vtkTransform>::New()),
      upper_rotor_(vtkSmartPointer<vtkTransform>::New()),
      lower_rotor_(vtkSmartPointer<vtkTransform>::New()),
      set_point_(vtkSmartPointer<vtkTransform>::New()) {
  renderer_->SetBackground(0.035, 0.046, 0.061);
  renderer_->SetBackground2(0.085, 0.110, 0.146);
  renderer_->GradientBackgroundOn();
  renderer_->GetActiveCamera()->SetViewAngle(toDegrees(0.61));
  buildPasses();
  buildFloor(setup);
  buildHelicopter(setup);
  buildRotors(setup);
  buildCameras(setup);
  buildFence(setup);
  buildPlan(setup);
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

void Scene::addToHelicopter(const vtkSmartPointer<vtkActor>& actor, vtkTransform* transform) {
  actor->SetUserTransform(transform);
  helicopter_.push_back(actor);
  add(actor);
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

void Scene::buildHelicopter(const SceneSetup& setup) {
  const double ground = -setup.helicopter.standing_height;
  const double top = setup.helicopter.upper.height;
  addToHelicopter(shapes::solid(merged({ellipsoid({-0.005, 0, 0.004}, {0.075, 0.036, 0.034}),
                                        ellipsoid({-0.02, 0, 0.035}, {0.045, 0.022, 0.022}),
                                        rod({-0.05, 0, 0.012}, {-0.255, 0, 0.030}, 0.013, 0.006),
                                        box({-0.245, 0, 0.050}, {0.036, 0.004, 0.070}),
                                        box({-0.215, 0, 0.028}, {0.026, 0.090, 0.003})}),
                                kShell),
                  body_);
  addToHelicopter(shapes::solid(merged({ellipsoid({0.040, 0, 0.004}, {0.048, 0.0345, 0.033})}), kGlass, 0.9),
                  body_);
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
  addToHelicopter(shapes::solid(merged(metal), kMetal), body_);
  addToHelicopter(shapes::solid(merged(balls), kBall, 0.5), body_);
}

void Scene::buildRotors(const SceneSetup& setup) {
  const HelicopterParameters& h = setup.helicopter;
  upper_rotor_->SetInput(body_);
  lower_rotor_->SetInput(body_);
  const double bar = h.upper.height + 0.028;
  addToHelicopter(shapes::solid(merged({box({0, 0, h.upper.height}, {2.0 * h.rotor_radius, 0.024, 0.0025}),
                                        rod({0, -0.09, bar}, {0, 0.09, bar}, 0.0018, 0.0018),
                                        ellipsoid({0, 0.09, bar}, {0.006, 0.010, 0.006}, 12),
                                        ellipsoid({0, -0.09, bar}, {0.006, 0.010, 0.006}, 12)}),
                                kBlade),
                  upper_rotor_);
  addToHelicopter(
      shapes::solid(merged({box({0, 0, h.lower.height}, {2.0 * h.rotor_radius, 0.024, 0.0025})}), kBlade),
      lower_rotor_);
  discs_ = {shapes::flat(shapes::ring(h.upper.height, 0.0, h.rotor_radius), kDisc),
            shapes::flat(shapes::ring(h.lower.height, 0.0, h.rotor_radius), kDisc)};
  for (const auto& disc : discs_) addToHelicopter(disc, body_);
}

void Scene::buildCameras(const SceneSetup& setup) {
  for (const SceneCamera& camera : setup.cameras) {
    camera_colors_.push_back(camera.color);
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
      const vtkIdType triangle[3] = {0, static_cast<vtkIdType>(1 + i),
                                     static_cast<vtkIdType>(1 + (i + 1) % 4)};
      triangles->InsertNextCell(3, triangle);
    }
    auto faces = Mesh::New();
    faces->SetPoints(points);
    faces->SetPolys(triangles);

    CameraActors actors;
    actors.body = shapes::solid(
        merged({box({0, 0, -0.07}, {0.075, 0.075, 0.10}), rod({0, 0, -0.02}, {0, 0, 0.03}, 0.03, 0.036)}),
        camera.color.darker(125));
    actors.edges = shapes::flat(shapes::segments(edges), camera.color);
    actors.faces = shapes::flat(faces, camera.color);
    for (const auto& actor : {actors.body, actors.edges, actors.faces}) {
      actor->SetUserTransform(actors.world_from_camera);
      add(actor);
    }
    actors.truth = shapes::flat(shapes::segments(dashed(edges, 0.012)), camera.color.lighter(140), 0.85, 1.4);
    actors.truth->SetUserTransform(actors.world_from_true_camera);
    actors.ellipsoid = shapes::flat(shapes::segments(sphereRings()), camera.color, 0.7);
    actors.ellipsoid->SetUserTransform(actors.spread);
    actors.cone = shapes::flat(shapes::segments(unitCone()), camera.color, 0.45);
    actors.cone_shape->SetInput(actors.world_from_camera);
    actors.cone->SetUserTransform(actors.cone_shape);
    for (const auto& actor : {actors.truth, actors.ellipsoid, actors.cone}) add(actor);
    cameras_.push_back(actors);
  }
}

void Scene::buildFence(const SceneSetup& setup) {
  std::vector<Vector3d> lines = circle(setup.fence_radius, 0.003);
  const std::vector<Vector3d> top = circle(setup.fence_radius, setup.fence_height);
  lines.insert(lines.end(), top.begin(), top.end());
  for (int i = 0; i < 12; ++i) {
    const Vector3d foot(setup.fence_radius * std::cos(kPi * i / 6.0),
                        setup.fence_radius * std::sin(kPi * i / 6.0), 0.003);
    lines.insert(lines.end(), {foot, Vector3d(foot.x(), foot.y(), setup.fence_height)});
  }
  fence_ = shapes::flat(shapes::segments(dashed(lines, 0.02)), theme::kCaution, 0.12);
  fence_->SetUserTransform(floor_);
  if (setup.fence_radius > 0.0) add(fence_);
}

void Scene::buildPlan(const SceneSetup& setup) {
  std::vector<Vector3d> legs;
  for (std::size_t i = 0; i < setup.plan.size(); ++i) {
    if (i > 0) legs.insert(legs.end(), {setup.plan[i - 1], setup.plan[i]});
    add(shapes::flat(ellipsoid(setup.plan[i], {0.012, 0.012, 0.012}, 12), theme::kCaution, 0.55));
  }
  if (!legs.empty()) add(shapes::flat(shapes::segments(dashed(legs, 0.02)), theme::kCaution, 0.5, 1.2));
}

void Scene::buildLines() {
  trail_ = std::make_unique<Polyline>();
  trail_->actor->GetProperty()->SetLineWidth(2.0F);
  rays_ = std::make_unique<Polyline>();
  drop_line_ = std::make_unique<Polyline>();
  particles_ = std::make_unique<Polyline>();
  particles_->actor->GetProperty()->SetPointSize(3.0F);
  coverage_ = std::make_unique<Polyline>();
  coverage_->actor->GetProperty()->SetLineWidth(1.2F);
  for (const Polyline* line :
       {coverage_.get(), trail_.get(), rays_.get(), drop_line_.get(), particles_.get()})
    add(line->actor);

  constexpr double kArm = 0.06;
  set_point_actor_ = shapes::flat(
      shapes::segments(
          {{-kArm, 0, 0}, {kArm, 0, 0}, {0, -kArm, 0}, {0, kArm, 0}, {0, 0, -kArm}, {0, 0, kArm}}),
      theme::kCaution, 0.9, 1.5);
  set_point_actor_->SetUserTransform(set_point_);
  add(set_point_actor_);
}

void Scene::show(const SceneFrame& frame) {
  floor_->Identity();
  floor_->Translate(0.0, 0.0, frame.floor_height);
  showHelicopter(frame);
  showCameras(frame);
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
  camera->SetClippingRange(0.1, 80.0);
}

void Scene::showHelicopter(const SceneFrame& frame) {
  body_->SetMatrix(matrixOf(frame.world_from_body).data());
  upper_rotor_->Identity();
  upper_rotor_->RotateZ(toDegrees(frame.upper_angle));
  lower_rotor_->Identity();
  lower_rotor_->RotateZ(toDegrees(frame.lower_angle));
  const double opacity = frame.presence == Presence::kTracked ? 1.0 : 0.3;
  for (const auto& actor : helicopter_) {
    actor->SetVisibility(frame.presence != Presence::kAbsent);
    actor->GetProperty()->SetOpacity(opacity);
  }
  discs_[0]->GetProperty()->SetOpacity(0.22 * opacity * frame.upper_demand);
  discs_[1]->GetProperty()->SetOpacity(0.22 * opacity * frame.lower_demand);
}

void Scene::showCameras(const SceneFrame& frame) {
  for (std::size_t i = 0; i < cameras_.size() && i < frame.cameras.size(); ++i) {
    const SceneCameraPose& pose = frame.cameras[i];
    const CameraActors& actors = cameras_[i];
    for (const auto& actor : {actors.body, actors.edges, actors.faces}) actor->SetVisibility(pose.known);
    actors.truth->SetVisibility(pose.has_truth);
    if (pose.has_truth)
      actors.world_from_true_camera->SetMatrix(matrixOf(pose.true_camera_from_world.inverse()).data());
    showSpread(actors, pose);
    if (!pose.known) continue;
    actors.world_from_camera->SetMatrix(matrixOf(pose.camera_from_world.inverse()).data());
    actors.body->GetProperty()->SetOpacity(pose.in_use ? 1.0 : 0.35);
    actors.edges->GetProperty()->SetOpacity(pose.in_use ? 0.75 : 0.25);
    actors.faces->GetProperty()->SetOpacity(pose.in_use ? 0.07 : 0.02);
  }
}

void Scene::showSpread(const CameraActors& actors, const SceneCameraPose& pose) {
  const bool shown = pose.known && pose.has_spread;
  // As thin as a line they look like one more line; as large as the room they say nothing.
  actors.ellipsoid->SetVisibility(shown && pose.spread_radii.maxCoeff() > kSeenSpread &&
                                  pose.spread_radii.maxCoeff() < kTellingSpread);
  actors.cone->SetVisibility(shown && pose.spread_angle > kSeenAngle && pose.spread_angle < kTellingAngle);
  if (!shown) return;
  const RigidTransform place{pose.spread_axes, pose.camera_from_world.inverseTranslation()};
  actors.spread->SetMatrix(matrixOf(place).data());
  actors.spread->Scale(pose.spread_radii.data());
  const double length = 1.6 * kFrustumLength,
               width = length * std::tan(std::min(pose.spread_angle, kTellingAngle));
  actors.cone_shape->Identity();
  actors.cone_shape->Scale(width, width, length);
}

void Scene::showCoverage(const SceneFrame& frame) {
  if (frame.coverage == shown_coverage_) return;
  shown_coverage_ = frame.coverage;
  coverage_->clear();
  for (std::size_t i = 0; frame.coverage && i + 1 < frame.coverage->size(); i += 2) {
    const vtkIdType from = coverage_->add((*frame.coverage)[i], theme::kHealthy, 80);
    coverage_->line(from, coverage_->add((*frame.coverage)[i + 1], theme::kHealthy, 80));
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
    const vtkIdType id = trail_->add(frame.trail[i], theme::kActive, static_cast<int>(220 * age * age));
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
    drop_line_->line(drop_line_->add(top, theme::kText, 70), drop_line_->add(foot, theme::kText, 110));
  }
  drop_line_->finish();
}

std::vector<SceneLabel> Scene::labels(const SceneFrame& frame, const QSizeF& size) const {
  vtkMatrix4x4* projection = renderer_->GetActiveCamera()->GetCompositeProjectionTransformMatrix(
      size.width() / std::max(1.0, size.height()), -1.0, 1.0);
  std::vector<SceneLabel> labels;
  for (std::size_t i = 0; i < frame.cameras.size(); ++i) {
    if (!frame.cameras[i].known) continue;
    const Vector3d above = frame.cameras[i].camera_from_world.inverseTranslation() + Vector3d(0, 0, 0.14);
    const std::array<double, 4> point{above.x(), above.y(), above.z(), 1.0};
    std::array<double, 4> clip{};
    projection->MultiplyPoint(point.data(), clip.data());
    if (clip[3] <= 0.0) continue;
    const QPointF position(0.5 * (1.0 + clip[0] / clip[3]) * size.width(),
                           0.5 * (1.0 - clip[1] / clip[3]) * size.height());
    labels.push_back({position, static_cast<int>(i), frame.cameras[i].in_use});
  }
  return labels;
}

}  // namespace helical
