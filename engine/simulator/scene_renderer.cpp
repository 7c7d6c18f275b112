#include "engine/simulator/scene_renderer.h"

#include <cmath>
#include <vector>

#include "engine/base/random.h"
#include "engine/geometry/rotation.h"
#include "engine/simulator/scene_background.h"
#include "engine/simulator/scene_board.h"
#include "engine/simulator/scene_helicopter.h"
#include "engine/simulator/scene_noise.h"
#include "engine/simulator/scene_shadow.h"

namespace helical {
namespace {

constexpr double kDriftPeriod = 60.0;  ///< s

bool isSame(const RigidTransform& a, const RigidTransform& b) {
  return a.rotation.coeffs() == b.rotation.coeffs() && a.translation == b.translation;
}

}  // namespace

struct SceneRenderer::Workspace {
  Workspace(const CameraModel& camera_model, const MarkerLayout& markers, const SceneOptions& scene_options)
      : model(camera_model),
        options(scene_options),
        random(scene_options.seed),
        drift_phase(random.uniform(0.0, 2.0 * kPi)),
        noise(random.fork(1), scene_options.image_noise),
        background(camera_model, random.fork(2)),
        board(camera_model.width(), camera_model.height(), noise),
        helicopter(camera_model, markers),
        pixels(3U * static_cast<std::size_t>(camera_model.width()) *
               static_cast<std::size_t>(camera_model.height())) {}

  double gainAt(double time_s) const {
    return 1.0 + options.light_drift * std::sin(2.0 * kPi * time_s / kDriftPeriod + drift_phase);
  }

  CameraModel model;
  SceneOptions options;
  Random random;
  double drift_phase;
  SceneNoise noise;
  SceneBackground background;
  SceneBoard board;
  SceneHelicopter helicopter;
  std::vector<std::uint8_t> pixels;
  std::optional<RigidTransform> rendered_pose;
};

SceneRenderer::SceneRenderer(const CameraModel& model, const MarkerLayout& markers_in_body,
                             const SceneOptions& options)
    : workspace_(std::make_unique<Workspace>(model, markers_in_body, options)) {}

SceneRenderer::~SceneRenderer() = default;
SceneRenderer::SceneRenderer(SceneRenderer&&) noexcept = default;
SceneRenderer& SceneRenderer::operator=(SceneRenderer&&) noexcept = default;

ImageView SceneRenderer::render(const RigidTransform& camera_from_world,
                                const std::optional<HelicopterView>& helicopter, double time_s,
                                double board) {
  Workspace& w = *workspace_;
  const double gain = w.gainAt(time_s);
  if (!w.rendered_pose || !isSame(*w.rendered_pose, camera_from_world)) {
    w.background.setPose(camera_from_world, gain, w.noise);
    w.rendered_pose = camera_from_world;
  }
  const ImageView picture{w.pixels.data(), w.model.width(), w.model.height(), 3 * w.model.width(),
                          PixelFormat::kBgr8};
  if (board < 1.0) {
    w.background.copyTo(w.pixels.data(), gain, w.noise);
    if (helicopter) {
      castShadow(w.model, camera_from_world, helicopter->world_from_body, w.background, w.pixels.data());
      w.helicopter.draw(camera_from_world, *helicopter, gain, w.noise, w.pixels.data());
    }
  }
  if (board > 0.0) w.board.cover(board, w.pixels.data(), w.random);
  return picture;
}

}  // namespace helical
