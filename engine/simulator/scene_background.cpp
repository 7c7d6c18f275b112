#include "engine/simulator/scene_background.h"

#include <algorithm>
#include <cmath>

#include "engine/simulator/scene_room.h"

namespace helical {
namespace {

constexpr int kCopies = 3;
constexpr int kRowsRenewedPerFrame = 32;
constexpr int kGridStep = 8;
constexpr int kSamples = 2;  ///< per pixel, on its diagonal
constexpr int kGainBits = 12;

}  // namespace

SceneBackground::SceneBackground(const CameraModel& model, Random random)
    : width_(model.width()), height_(model.height()), grid_width_(width_ / kGridStep + 2), random_(random) {
  const std::size_t pixels = static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_);
  clean_.resize(3 * pixels);
  is_floor_.resize(pixels);
  noisy_.assign(kCopies, std::vector<std::uint8_t>(3 * pixels));
  prepareBearings(model);
}

void SceneBackground::prepareBearings(const CameraModel& model) {
  for (int y = 0; y <= height_ / kGridStep + 1; ++y)
    for (int x = 0; x < grid_width_; ++x)
      grid_.push_back(model.bearing(Eigen::Vector2d(x * kGridStep - 0.5, y * kGridStep - 0.5)));
}

Eigen::Vector2d SceneBackground::bearing(double x, double y) const {
  const double gx = (x + 0.5) / kGridStep, gy = (y + 0.5) / kGridStep;
  const int ix = static_cast<int>(gx), iy = static_cast<int>(gy);
  const double u = gx - ix, v = gy - iy;
  const Eigen::Vector2d* top = grid_.data() + iy * grid_width_ + ix;
  const Eigen::Vector2d* bottom = top + grid_width_;
  return (1.0 - v) * ((1.0 - u) * top[0] + u * top[1]) + v * ((1.0 - u) * bottom[0] + u * bottom[1]);
}

void SceneBackground::setPose(const RigidTransform& camera_from_world, double gain, SceneNoise& noise) {
  for (int y = 0; y < height_; ++y) renderRow(y, camera_from_world);
  for (int copy = 0; copy < kCopies; ++copy)
    for (int y = 0; y < height_; ++y) renewRow(copy, y, gain, noise);
}

void SceneBackground::renderRow(int y, const RigidTransform& camera_from_world) {
  const Eigen::Matrix3d world_from_camera = camera_from_world.rotation.conjugate().toRotationMatrix();
  const Eigen::Vector3d centre = camera_from_world.inverseTranslation();
  constexpr float kShare = 1.0F / kSamples;
  for (int x = 0; x < width_; ++x) {
    Eigen::Vector3f sum = Eigen::Vector3f::Zero();
    float vignette = 1.0F;
    for (int s = 0; s < kSamples; ++s) {
      const double offset = (s + 0.5) / kSamples - 0.5;
      const Eigen::Vector2d b = bearing(x + offset, y + offset);
      const SceneColour colour = roomColour(centre, world_from_camera * Eigen::Vector3d(b.x(), b.y(), 1.0));
      sum += colour.bgr;
      is_floor_[index(x, y)] = colour.is_floor ? 1 : 0;
      vignette = 1.0F - 0.30F * static_cast<float>(b.squaredNorm());
    }
    for (int c = 0; c < 3; ++c)
      clean_[3 * index(x, y) + static_cast<std::size_t>(c)] = static_cast<std::uint16_t>(
          std::clamp(sum[c] * kShare * vignette, 0.0F, 255.0F) * SceneNoise::kUnitsPerLevel);
  }
}

void SceneBackground::renewRow(int copy, int y, double gain, SceneNoise& noise) {
  const int count = 3 * width_;
  const std::int16_t* deviates = noise.stretch(count);
  const std::uint16_t* clean = clean_.data() + 3 * index(0, y);
  std::uint8_t* out = noisy_[static_cast<std::size_t>(copy)].data() + 3 * index(0, y);
  const auto scale = static_cast<std::int32_t>(std::lround(gain * (1 << kGainBits)));
  for (int i = 0; i < count; ++i) {
    const std::int32_t value = (clean[i] * scale >> kGainBits) + deviates[i] + SceneNoise::kUnitsPerLevel / 2;
    out[i] = static_cast<std::uint8_t>(std::clamp(value / SceneNoise::kUnitsPerLevel, 0, 255));
  }
}

void SceneBackground::copyTo(std::uint8_t* bgr, double gain, SceneNoise& noise) {
  for (int i = 0; i < kRowsRenewedPerFrame; ++i) {
    renewRow(next_copy_, next_row_, gain, noise);
    if (++next_row_ < height_) continue;
    next_row_ = 0;
    next_copy_ = (next_copy_ + 1) % kCopies;
  }
  // Never the same picture twice in a row.
  shown_ = (shown_ + 1 + static_cast<int>(random_.bits() % (kCopies - 1))) % kCopies;
  const auto& source = noisy_[static_cast<std::size_t>(shown_)];
  std::copy(source.begin(), source.end(), bgr);
}

}  // namespace helical
