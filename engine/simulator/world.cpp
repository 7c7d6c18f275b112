#include "engine/simulator/world.h"

#include <algorithm>
#include <cmath>

#include "engine/base/check.h"
#include "engine/geometry/rotation.h"
#include "engine/simulator/disturbances.h"
#include "engine/simulator/random_streams.h"

namespace helical {
namespace {

constexpr TimeNs kStep = kNanosecondsPerMillisecond;
constexpr double kStepS = 1e-3;
constexpr std::int64_t kHistory = 256;

// Gusts: first-order noise, standard deviations and correlation times of a drafty hall.
constexpr double kWindLateral = 0.3, kWindVertical = 0.15, kWindTime = 0.7;    // m/s, m/s, s
constexpr double kMomentLateral = 5e-4, kMomentYaw = 1e-4, kMomentTime = 0.3;  // N m, N m, s

constexpr double kPadSigma = 0.01;  // m, how well somebody puts it on the pad
constexpr double kPadYaw = 0.2;     // rad

constexpr double kCrashTilt = toRadians(50.0);
constexpr double kCrashTouch = 1.0;                       // m/s
constexpr double kFieldRadius = 2.5, kFieldHeight = 2.5;  // m

HelicopterParameters drawn(const SimulationOptions& options, const HelicopterParameters& nominal) {
  Random random = randomStream(options.seed, RandomStream::kParameters);
  return varied(nominal, options.vary, random);
}

}  // namespace

World::World(const SimulationOptions& options, const HelicopterParameters& nominal, double carried_s)
    : options_(options),
      random_(randomStream(options.seed, RandomStream::kGusts)),
      dynamics_(drawn(options, nominal)),
      earliest_placing_(fromSeconds(options.field_empty_s) / kStep),
      history_(kHistory) {
  Random placement = randomStream(options.seed, RandomStream::kPlacement);
  const double x = kPadSigma * placement.normal(), y = kPadSigma * placement.normal();
  dynamics_.placeOnGround(x, y, kPadYaw * placement.uniform(-1.0, 1.0));
  history_[0].state = dynamics_.state();
  if (carried_s > 0.0)
    carried_.emplace(carried_s, dynamics_.state().world_from_body,
                     randomStream(options.seed, RandomStream::kCarrying));
}

bool World::isCarried() const {
  return carried_ && placed_at_step_ >= 0 &&
         static_cast<double>(step_ - placed_at_step_) * kStepS < carried_->duration();
}

void World::advanceTo(TimeNs time) {
  const std::lock_guard lock(mutex_);
  while ((step_ + 1) * kStep <= time) stepOnce();
  // One step beyond, so that every time up to now lies between two samples.
  if (step_ * kStep < time) stepOnce();
}

void World::stepOnce() {
  while (!commands_.empty() && commands_.front().when <= step_ * kStep) {
    sticks_ = commands_.front().demand;
    commands_.pop_front();
  }
  if (placed_at_step_ < 0 && step_ >= earliest_placing_ && holds_ == 0) placed_at_step_ = step_;
  ++step_;
  if (isCarried()) {
    const double since_s = static_cast<double>(step_ - placed_at_step_) * kStepS;
    history_[static_cast<std::size_t>(step_ % kHistory)] = {carried_->at(since_s), upper_angle_, lower_angle_};
    return;
  }
  if (placed_at_step_ >= 0 && !verdict_.crashed) {
    blow(kStepS);
    dynamics_.step(sticks_, airNow(), kStepS);
    upper_angle_ = std::remainder(upper_angle_ + dynamics_.upperRotorSpeed() * kStepS, 2.0 * kPi);
    lower_angle_ = std::remainder(lower_angle_ - dynamics_.lowerRotorSpeed() * kStepS, 2.0 * kPi);
    judge();
  }
  history_[static_cast<std::size_t>(step_ % kHistory)] = {dynamics_.state(), upper_angle_, lower_angle_};
}

void World::blow(double dt) {
  const auto drift = [&](double& value, double sigma, double time) {
    value += -value * dt / time + sigma * std::sqrt(2.0 * dt / time) * random_.normal();
  };
  const double f = options_.gust_factor;
  if (f <= 0.0) return;
  drift(gust_.wind_in_world.x(), f * kWindLateral, kWindTime);
  drift(gust_.wind_in_world.y(), f * kWindLateral, kWindTime);
  drift(gust_.wind_in_world.z(), f * kWindVertical, kWindTime);
  drift(gust_.moment_in_body.x(), f * kMomentLateral, kMomentTime);
  drift(gust_.moment_in_body.y(), f * kMomentLateral, kMomentTime);
  drift(gust_.moment_in_body.z(), f * kMomentYaw, kMomentTime);
}

Gust World::airNow() const {
  Gust air = gust_;
  const double phase =
      (static_cast<double>(step_) * kStepS - ordered_since_s_) / std::max(ordered_duration_s_, kStepS);
  if (phase < 1.0) air.wind_in_world += std::sin(kPi * phase) * ordered_wind_;
  return air;
}

void World::gust(const Eigen::Vector3d& wind, double duration_s) {
  const std::lock_guard lock(mutex_);
  ordered_wind_ = wind;
  ordered_since_s_ = static_cast<double>(step_) * kStepS;
  ordered_duration_s_ = duration_s;
}

void World::knock(CameraId camera, double angle, double distance) {
  const std::lock_guard lock(mutex_);
  const Random random = randomStream(options_.seed, RandomStream::kKnocks, camera).fork(knocks_.size() + 1);
  knocks_.push_back({camera, angle, distance, random});
}

RigidTransform World::knocked(CameraId camera, const RigidTransform& camera_from_world) const {
  const std::lock_guard lock(mutex_);
  RigidTransform pose = camera_from_world;
  for (const Knock& knock : knocks_)
    if (knock.camera == camera) pose = displaced(pose, knock.angle, knock.distance, knock.random);
  const auto& correction = true_from_knocked_[static_cast<std::size_t>(camera.index())];
  return correction ? *correction * pose : pose;
}

void World::setRight(const HelicopterState& state, TimeNs time) {
  const std::lock_guard lock(mutex_);
  if (placed_at_step_ < 0) placed_at_step_ = step_;
  if (isCarried()) return;
  HelicopterState now = state;
  const double since_s = toSeconds(step_ * kStep - time);
  now.world_from_body.translation += since_s * state.velocity_in_world;
  now.world_from_body.rotation = now.world_from_body.rotation * expSO3(since_s * state.angular_velocity_in_body);
  dynamics_.setState(now);
  history_[static_cast<std::size_t>(step_ % kHistory)].state = dynamics_.state();
}

void World::setRight(CameraId camera, const RigidTransform& camera_from_world,
                     const RigidTransform& true_camera_from_world) {
  const std::lock_guard lock(mutex_);
  true_from_knocked_[static_cast<std::size_t>(camera.index())] =
      true_camera_from_world * camera_from_world.inverse();
}

void World::judge() {
  const HelicopterState state = dynamics_.state();
  const Eigen::Vector3d& position = state.world_from_body.translation;
  const double height = position.z() - dynamics_.parameters().standing_height;
  verdict_.has_flown = verdict_.has_flown || height > 0.1;
  verdict_.hardest_touch = dynamics_.hardestTouch();
  verdict_.at_rest = dynamics_.onGround() && height < 0.03 && tiltOf(state.world_from_body.rotation) < 0.35 &&
                     state.velocity_in_world.norm() < 0.05 && dynamics_.upperRotorSpeed() < 60.0;
  const auto crash = [&](const char* reason) {
    if (verdict_.crashed) return;
    verdict_.crashed = true;
    verdict_.reason = reason;
    verdict_.crash_time_s = static_cast<double>(step_) * kStepS;
  };
  if (tiltOf(state.world_from_body.rotation) > kCrashTilt)
    crash("tipped over");
  else if (verdict_.hardest_touch > kCrashTouch)
    crash("hit the ground");
  else if (position.head<2>().norm() > kFieldRadius)
    crash("left the field");
  else if (position.z() > kFieldHeight)
    crash("left the field upwards");
}

std::optional<WorldSample> World::at(TimeNs time) const {
  const std::lock_guard lock(mutex_);
  HELICAL_CHECK(time <= step_ * kStep);
  const std::int64_t before = time / kStep;
  if (placed_at_step_ < 0 || before < placed_at_step_) return std::nullopt;
  if (before >= cleared_from_ && before < cleared_until_) return std::nullopt;
  const std::int64_t first = std::max<std::int64_t>(before, step_ - kHistory + 1);
  const WorldSample& a = history_[static_cast<std::size_t>(first % kHistory)];
  if (first == step_) return a;
  const WorldSample& b = history_[static_cast<std::size_t>((first + 1) % kHistory)];
  const double f =
      std::clamp(static_cast<double>(time - first * kStep) / static_cast<double>(kStep), 0.0, 1.0);
  WorldSample sample = a;
  RigidTransform& pose = sample.state.world_from_body;
  pose.translation += f * (b.state.world_from_body.translation - pose.translation);
  pose.rotation = a.state.world_from_body.rotation.slerp(f, b.state.world_from_body.rotation);
  sample.state.velocity_in_world += f * (b.state.velocity_in_world - a.state.velocity_in_world);
  sample.state.angular_velocity_in_body +=
      f * (b.state.angular_velocity_in_body - a.state.angular_velocity_in_body);
  return sample;
}

void World::holdEmpty() {
  const std::lock_guard lock(mutex_);
  ++holds_;
}

void World::releaseEmpty() {
  const std::lock_guard lock(mutex_);
  --holds_;
}

void World::clearField(double duration_s) {
  const std::lock_guard lock(mutex_);
  cleared_from_ = step_;
  cleared_until_ = step_ + static_cast<std::int64_t>(duration_s / kStepS);
}

void World::command(const StickDemand& demand, TimeNs when) {
  const std::lock_guard lock(mutex_);
  commands_.push_back({when, demand});
}

Verdict World::verdict() const {
  const std::lock_guard lock(mutex_);
  return verdict_;
}

}  // namespace helical
