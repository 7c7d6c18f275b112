#include "engine/markers/shaded_disc.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <span>

#include "engine/markers/cut_disc.h"
#include "engine/markers/disc_normal.h"

namespace helical {
namespace {

constexpr double kLongTail = 1.8;  ///< mean square over that of a normal distribution: something does not fit
constexpr double kSettled = 3e-3;  ///< cells: a smaller step is the last
constexpr double kRim = 1.5;       ///< cells on either side of the outline, where a motion shows

/// The unknowns: those of the model, and of a second channel the ball's level over that of the first, and the
/// level around it.
constexpr int kRatio = kDiscParameters, kSecondAround = kRatio + 1, kUnknowns = kSecondAround + 1;
constexpr double kUneven = 3.0;       ///< scatter of the brightness over that of the colour that is too much
constexpr float kOutside = 3.5F;      ///< scales: what lies farther off is no noise
constexpr double kSeenOutline = 0.5;  ///< share of the outline that the brightness must show

using Normal = Eigen::Matrix<double, kUnknowns, kUnknowns>;
using Vector = Eigen::Matrix<double, kUnknowns, 1>;
using ModelVector = Eigen::Matrix<double, kDiscParameters, 1>;

}  // namespace

/// The normal equations at the current parameters.
struct ShadedDisc::System {
  Normal normal = Normal::Zero();
  Vector gradient = Vector::Zero();
  double count = 0.0;  ///< of the values
  double squares = 0.0;
};

double ShadedDisc::contrast() const {
  return p_[kDiscAmbient] + std::max(0.0F, p_[kDiscLightZ]) - p_[kDiscAround];
}

void ShadedDisc::start(const OutlineCircle& circle) {
  brightness_weight_ = 0.0;
  const DiscCells& cells = *window_.colour;
  double inside = 0.0, outside = 0.0;
  int inside_count = 0, outside_count = 0;
  for (std::size_t i = 0; i < cells.count; ++i) {
    if (cells.given[i] == 0.0F) continue;
    const double dx = cells.x[i] - circle.centre.x, dy = cells.y[i] - circle.centre.y, d2 = dx * dx + dy * dy;
    if (d2 < 0.4 * circle.radius * circle.radius) inside += cells.value[i], ++inside_count;
    if (d2 > (circle.radius + 1.0) * (circle.radius + 1.0)) outside += cells.value[i], ++outside_count;
  }
  p_.fill(0.0F);
  p_[kDiscX] = static_cast<float>(circle.centre.x);
  p_[kDiscY] = static_cast<float>(circle.centre.y);
  p_[kDiscRadius] = static_cast<float>(circle.radius);
  p_[kDiscAmbient] = static_cast<float>(inside / std::max(1, inside_count));
  p_[kDiscAround] = static_cast<float>(outside / std::max(1, outside_count));
}

bool ShadedDisc::startBrightness() {
  DiscCells &colour = *window_.colour, &brightness = *window_.brightness;
  brightness.count = colour.count;
  std::copy_n(colour.x.begin(), colour.count, brightness.x.begin());
  std::copy_n(colour.y.begin(), colour.count, brightness.y.begin());
  std::copy_n(colour.given.begin(), colour.count, brightness.given.begin());
  evaluateDisc(p_, hasShadow(p_), colour);
  const float colour_scale = window_.residualScale(colour);
  levelBrightness();
  evaluateDisc(brightnessParameters(), hasShadow(p_), brightness);
  leaveOutUneven(kOutside * window_.residualScale(brightness));
  const float scale = window_.residualScale(brightness);
  if (scale > kUneven * colour_scale) return false;
  brightness_weight_ =
      static_cast<double>(colour_scale) * colour_scale / (static_cast<double>(scale) * scale);
  double outline = 0.0, seen = 0.0;
  for (std::size_t i = 0; i < window_.real_count; ++i) {
    if (colour.given[i] == 0.0F || colour.cover[i] < 0.05F || colour.cover[i] > 0.95F) continue;
    outline += 1.0;
    seen += brightness.given[i];
  }
  return seen > kSeenOutline * outline;
}

void ShadedDisc::levelBrightness() {
  const DiscCells &colour = *window_.colour, &brightness = *window_.brightness;
  const auto medianOver = [&](auto isWanted, auto valueOf) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < window_.real_count; ++i)
      if (colour.given[i] != 0.0F && isWanted(colour.cover[i])) window_.sorted[count++] = valueOf(i);
    return count > 0 ? medianOf(std::span(window_.sorted.data(), count)) : 0.0F;
  };
  brightness_around_ = medianOver([](float cover) { return cover == 0.0F; },
                                  [&](std::size_t i) { return brightness.value[i]; });
  brightness_over_colour_ =
      medianOver([](float cover) { return cover == 1.0F; },
                 [&](std::size_t i) { return brightness.value[i] / (colour.value[i] - colour.residual[i]); });
}

void ShadedDisc::leaveOutUneven(float limit) {
  DiscCells& cells = *window_.brightness;
  // What is hidden stays marked in the colour's cells only.
  const auto hidden = window_.is_marked;
  window_.is_marked.fill(0);
  for (std::size_t i = 0; i < window_.real_count; ++i)
    if (std::abs(cells.residual[i]) > limit) window_.is_marked[window_.placeOf(i)] = 1;
  window_.leaveOutMarked(cells);
  window_.is_marked = hidden;
}

ShadedDisc::Parameters ShadedDisc::brightnessParameters() const {
  Parameters p = p_;
  for (const DiscParameter k : {kDiscAmbient, kDiscLightX, kDiscLightY, kDiscLightZ})
    p[k] *= brightness_over_colour_;
  p[kDiscAround] = brightness_around_;
  return p;
}

ShadedDisc::System ShadedDisc::linearise() {
  System system;
  DiscSums sums;
  evaluateDisc(p_, hasShadow(p_), *window_.colour);
  sumDisc(*window_.colour, sums);
  system.normal.topLeftCorner<kDiscParameters, kDiscParameters>() = normalOf<kDiscParameters>(sums);
  system.gradient.head<kDiscParameters>() = Eigen::Map<const ModelVector>(sums.gradient.data());
  system.count = sums.count;
  system.squares = sums.squares;
  if (brightness_weight_ > 0.0) {
    evaluateDisc(brightnessParameters(), hasShadow(p_), *window_.brightness);
    sumDisc(*window_.brightness, sums);
    Eigen::Matrix<double, kDiscParameters, kUnknowns> chain =
        Eigen::Matrix<double, kDiscParameters, kUnknowns>::Zero();
    for (const DiscParameter k : {kDiscX, kDiscY, kDiscRadius}) chain(k, k) = 1.0;
    for (const DiscParameter k : {kDiscAmbient, kDiscLightX, kDiscLightY, kDiscLightZ}) {
      chain(k, k) = brightness_over_colour_;
      chain(k, kRatio) = p_[k];
    }
    chain(kDiscAround, kSecondAround) = 1.0;
    system.normal += brightness_weight_ * (chain.transpose() * normalOf<kDiscParameters>(sums) * chain);
    system.gradient +=
        brightness_weight_ * (chain.transpose() * Eigen::Map<const ModelVector>(sums.gradient.data()));
    system.count += sums.count;
    system.squares += brightness_weight_ * sums.squares;
  }
  system.normal.diagonal().array() += 1e-9;
  const double ambient = p_[kDiscAmbient], prior = lightPrior(ambient);
  system.normal(kDiscLightZ, kDiscLightZ) += prior;
  system.gradient[kDiscLightZ] -= prior * p_[kDiscLightZ];
  return system;
}

bool ShadedDisc::descend(int steps) {
  for (int step = 0; step < steps; ++step) {
    const System system = linearise();
    if (!(system.count > kUnknowns)) return false;
    Vector change = system.normal.ldlt().solve(system.gradient);
    const double moved = std::sqrt(change.head<3>().squaredNorm()), most = 0.4 * p_[kDiscRadius];
    if (!(moved < 1e6)) return false;
    if (moved > most) change *= most / moved;
    for (int k = 0; k < kDiscParameters; ++k)
      p_[static_cast<std::size_t>(k)] += static_cast<float>(change[k]);
    brightness_over_colour_ += static_cast<float>(change[kRatio]);
    brightness_around_ += static_cast<float>(change[kSecondAround]);
    if (!(p_[kDiscRadius] > kSmallestDisc)) return false;
    if (step > 1 && moved < kSettled) break;
  }
  return true;
}

bool ShadedDisc::fitsEverywhere() {
  const System system = linearise();
  // Where the whole ball fits badly, the scatter of all cells would excuse it; around it there is noise
  // alone.
  const double scale = window_.noiseAround();
  return system.squares < kLongTail * scale * scale * system.count;
}

double ShadedDisc::motionInResiduals() {
  const DiscCells& cells = *window_.colour;
  const double x = p_[kDiscX], y = p_[kDiscY], radius = p_[kDiscRadius], noise = window_.noiseAround();
  const double least = std::max(0.0, radius - kRim), most = radius + kRim;
  double by_cosine = 0.0, by_sine = 0.0, weights = 0.0;
  for (std::size_t i = 0; i < window_.real_count; ++i) {
    const double dx = cells.x[i] - x, dy = cells.y[i] - y, d2 = dx * dx + dy * dy;
    if (d2 <= least * least || d2 >= most * most) continue;
    const double beyond = std::sqrt(d2) - radius,
                 value = beyond * static_cast<double>(cells.residual[i]) / d2;
    by_cosine += value * (dx * dx - dy * dy);
    by_sine += value * 2.0 * dx * dy;
    weights += beyond * beyond;
  }
  return (by_cosine * by_cosine + by_sine * by_sine) / (0.5 * noise * noise * std::max(1e-9, weights));
}

void ShadedDisc::leaveOutHidden() {
  DiscCells& cells = *window_.colour;
  evaluateDisc(p_, hasShadow(p_), cells);
  window_.is_marked.fill(0);
  const float around = p_[kDiscAround];
  for (std::size_t i = 0; i < window_.real_count; ++i) {
    const float expected = cells.value[i] - cells.residual[i] - around;
    cells.given[i] = window_.givenAt(cells.x[i], cells.y[i]);
    if (cells.cover[i] > 0.5F && cells.value[i] - around < 0.5F * expected)
      window_.is_marked[window_.placeOf(i)] = 1;
  }
  window_.leaveOutMarked(cells);
}

ShadedDisc::Quality ShadedDisc::quality() {
  const System system = linearise();
  Quality quality;
  quality.variance = std::max(kLeastVariance, system.squares / std::max(1.0, system.count - kUnknowns));
  const Normal inverse = system.normal.ldlt().solve(Normal::Identity());
  quality.covariance = quality.variance * inverse.topLeftCorner<2, 2>();
  return quality;
}

double ShadedDisc::seenCells() const {
  const DiscCells& cells = *window_.colour;
  double seen = 0.0;
  for (std::size_t i = 0; i < window_.real_count; ++i)
    if (window_.is_marked[window_.placeOf(i)] == 0 && window_.givenAt(cells.x[i], cells.y[i]) != 0.0F)
      seen += cells.cover[i];
  return seen;
}

}  // namespace helical
