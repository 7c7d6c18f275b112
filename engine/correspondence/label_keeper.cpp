#include "engine/correspondence/label_keeper.h"

#include <algorithm>

#include "engine/base/check.h"
#include "engine/base/require.h"

namespace helical {
namespace {

constexpr double kGateChi2 = 1.0;  // predictions carry the gate itself as their standard deviation

double median(std::array<double, kMaxMarkers>& values, int count) {
  const auto middle = values.begin() + count / 2;
  std::nth_element(values.begin(), middle, values.begin() + count);
  return *middle;
}

}  // namespace

void validate(const LabelKeeperOptions& options) {
  requirePositive(options.gate_px, "gate_px");
  requirePositive(options.gate_growth_px_s, "gate_growth_px_s");
  requirePositive(options.agreement_px, "agreement_px");
  requirePositive(options.velocity_s, "velocity_s");
  requirePositive(options.lost_after_s, "lost_after_s");
}

LabelKeeper::LabelKeeper(const LabelKeeperOptions& options, int marker_count)
    : options_(options), marker_count_(marker_count) {
  validate(options_);
  HELICAL_CHECK(marker_count >= 3 && marker_count <= kMaxMarkers);
}

void LabelKeeper::restart(const Observation& observation, const Names& names) {
  time_ = enough_ = observation.exposure;
  int known = 0;
  for (int m = 0; m < marker_count_; ++m) {
    Ball& ball = balls_[static_cast<std::size_t>(m)];
    ball = {};
    const int name = names[static_cast<std::size_t>(m)];
    if (name < 0) continue;
    const Centroid& centroid = observation.centroids[static_cast<std::size_t>(name)];
    ball = {true, time_, centroid.pixel, Eigen::Vector2d::Zero(), centroid.radius_px};
    ++known;
  }
  lost_ = known < 3;
}

void LabelKeeper::predict(TimeNs time) {
  const double elapsed = toSeconds(time - time_);
  for (Ball& ball : balls_) ball.pixel += elapsed * ball.velocity;
  time_ = time;
}

Names LabelKeeper::nearest(const Observation& observation) const {
  std::array<MarkerPrediction, kMaxMarkers> predictions;
  for (int m = 0; m < marker_count_; ++m) {
    const Ball& ball = balls_[static_cast<std::size_t>(m)];
    const double gate = options_.gate_px + options_.gate_growth_px_s * toSeconds(time_ - ball.seen);
    predictions[static_cast<std::size_t>(m)] = {ball.known, ball.pixel,
                                                gate * gate * Eigen::Matrix2d::Identity(), ball.radius_px};
  }
  return nameByPrediction({predictions.data(), static_cast<std::size_t>(marker_count_)}, observation,
                          kGateChi2);
}

Eigen::Vector2d LabelKeeper::commonShift(const Observation& observation, const Names& names) const {
  std::array<double, kMaxMarkers> x, y;
  int count = 0;
  for (int m = 0; m < marker_count_; ++m) {
    const int name = names[static_cast<std::size_t>(m)];
    if (name < 0) continue;
    const Eigen::Vector2d shift = observation.centroids[static_cast<std::size_t>(name)].pixel -
                                  balls_[static_cast<std::size_t>(m)].pixel;
    x[static_cast<std::size_t>(count)] = shift.x();
    y[static_cast<std::size_t>(count++)] = shift.y();
  }
  if (count == 0) return Eigen::Vector2d::Zero();
  return {median(x, count), median(y, count)};
}

void LabelKeeper::correct(const Observation& observation, const Names& names, double elapsed_s) {
  const double gain = elapsed_s / (options_.velocity_s + elapsed_s);
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();
  int seen = 0;
  for (int m = 0; m < marker_count_; ++m) {
    const int name = names[static_cast<std::size_t>(m)];
    if (name < 0) continue;
    Ball& ball = balls_[static_cast<std::size_t>(m)];
    const Centroid& centroid = observation.centroids[static_cast<std::size_t>(name)];
    if (elapsed_s > 0.0 && ball.known) ball.velocity += gain / elapsed_s * (centroid.pixel - ball.pixel);
    ball.known = true;
    ball.pixel = centroid.pixel;
    ball.radius_px = centroid.radius_px;
    ball.seen = time_;
    velocity += ball.velocity;
    ++seen;
  }
  if (seen == 0) return;
  for (int m = 0; m < marker_count_; ++m)
    if (names[static_cast<std::size_t>(m)] < 0)
      balls_[static_cast<std::size_t>(m)].velocity = velocity / seen;
}

Names LabelKeeper::follow(const Observation& observation) {
  Names names;
  names.fill(-1);
  const double elapsed_s = toSeconds(observation.exposure - time_);
  if (lost_ || elapsed_s < 0.0) return names;
  predict(observation.exposure);
  names = nearest(observation);
  const Eigen::Vector2d shift = commonShift(observation, names);
  int named = 0;
  for (int m = 0; m < marker_count_; ++m) {
    Ball& ball = balls_[static_cast<std::size_t>(m)];
    int& name = names[static_cast<std::size_t>(m)];
    if (name >= 0 &&
        (observation.centroids[static_cast<std::size_t>(name)].pixel - ball.pixel - shift).norm() >
            options_.agreement_px)
      name = -1;
    if (name < 0)
      ball.pixel += shift;
    else
      ++named;
  }
  correct(observation, names, elapsed_s);
  if (named >= 3) enough_ = time_;
  lost_ = toSeconds(time_ - enough_) > options_.lost_after_s;
  if (lost_) names.fill(-1);
  return names;
}

}  // namespace helical
