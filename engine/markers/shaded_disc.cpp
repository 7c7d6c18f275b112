#include "engine/markers/shaded_disc.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/markers/cell_scatter.h"
#include "engine/markers/disc_descent.h"

namespace helical {
namespace {

constexpr double kLongTail = 1.8;  ///< mean square over that of a normal distribution: something does not fit
constexpr double kSettled = 3e-3;  ///< cells: a smaller step is the last
constexpr double kRim = 1.5;       ///< cells on either side of the outline, where a motion shows

constexpr double kUneven = 3.0;       ///< scatter of the brightness over that of the colour that is too much
constexpr float kOutside = 3.5F;      ///< scales: what lies farther off is no noise
constexpr double kSeenOutline = 0.5;  ///< share of the outline that the brightness must show

}  // namespace

double ShadedDisc::contrast() const {
  return p_[kDiscAmbient] + std::max(0.0F, p_[kDiscLightZ]) - p_[kDiscAround];
}

void ShadedDisc::start(const OutlineCircle& circle) {
  const ValueWindow values = window_.values();
  DiscValues flat{};
  flat[kDiscX] = static_cast<float>(circle.centre.x);
  flat[kDiscY] = static_cast<float>(circle.centre.y);
  flat[kDiscRadius] = static_cast<float>(circle.radius);
  flat[kDiscAmbient] = values.level + values.contrast;
  flat[kDiscAround] = values.level - values.contrast;
  start(flat);
}

void ShadedDisc::start(const DiscValues& parameters) {
  p_ = parameters;
  brightness_weight_ = 0.0;
  is_current_ = false;
}

bool ShadedDisc::startBrightness() {
  DiscCells &colour = *window_.colour, &brightness = *window_.brightness;
  system();
  levelBrightness();
  brightness.count = colour.count;
  std::copy_n(colour.given.begin(), colour.count, brightness.given.begin());
  DiscSums sums, second_sums;
  measureTwo(p_, brightness_, colour, brightness, sums, second_sums);
  const double colour_scale = residualScale(colour, window_.room);
  const float limit = kOutside * residualScale(brightness, window_.room);
  for (std::size_t i = 0; i < window_.real_count; ++i)
    if (std::abs(brightness.residual[i]) > limit) window_.leaveOut(i, brightness);
  const double scale = residualScale(brightness, window_.room);
  if (scale > kUneven * colour_scale) return false;
  brightness_weight_ = colour_scale * colour_scale / (scale * scale);
  is_current_ = false;
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
  const auto medianOver = [&](float cover, auto valueOf) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < window_.real_count; ++i) {
      window_.room[count] = valueOf(i);
      count += colour.given[i] != 0.0F && colour.cover[i] == cover ? 1 : 0;
    }
    return count > 0 ? medianOf({window_.room.data(), count}) : 0.0F;
  };
  brightness_.around = medianOver(0.0F, [&](std::size_t i) { return brightness.value[i]; });
  brightness_.ratio = medianOver(
      1.0F, [&](std::size_t i) { return brightness.value[i] / (colour.value[i] - colour.residual[i]); });
}

const ShadedDisc::System& ShadedDisc::system() {
  if (is_current_) return system_;
  is_current_ = true;
  noise_.reset();
  system_.normal.setZero();
  system_.gradient.setZero();
  DiscSums sums, second_sums;
  if (hasBrightness())
    measureTwo(p_, brightness_, *window_.colour, *window_.brightness, sums, second_sums);
  else
    measureDisc(p_, *window_.colour, sums);
  const double ambient = p_[kDiscAmbient], prior = lightPrior(ambient);
  system_.normal.topLeftCorner<kDiscParameters, kDiscParameters>() =
      normalWithPrior<kDiscParameters>(sums, ambient);
  for (int k = 0; k < kDiscParameters; ++k) system_.gradient[k] = sums.gradient[static_cast<std::size_t>(k)];
  system_.gradient[kDiscLightZ] -= prior * p_[kDiscLightZ];
  system_.count = sums.count;
  system_.squares = sums.squares;
  if (hasBrightness()) addBrightness(second_sums);
  return system_;
}

void ShadedDisc::addBrightness(const DiscSums& sums) {
  // Where the second picture's parameters stand among the unknowns.
  constexpr std::array<int, kSecondParameters> kPlaces{kDiscX,       kDiscY,        kDiscRadius,
                                                       kDiscAmbient, kDiscLightX,   kDiscLightY,
                                                       kDiscLightZ,  kSecondAround, kRatio};
  for (std::size_t a = 0; a < kPlaces.size(); ++a) {
    system_.gradient[kPlaces[a]] += brightness_weight_ * sums.gradient[a];
    for (std::size_t b = 0; b <= a; ++b) {
      const double product = brightness_weight_ * sums.normal[a][b];
      system_.normal(kPlaces[a], kPlaces[b]) += product;
      if (a != b) system_.normal(kPlaces[b], kPlaces[a]) += product;
    }
  }
  system_.count += sums.count;
  system_.squares += brightness_weight_ * sums.squares;
}

Eigen::Matrix<double, ShadedDisc::kUnknowns, 1> ShadedDisc::step() {
  const System& at = system();
  if (hasBrightness()) return NormalSolver<kUnknowns>(at.normal).solve(at.gradient);
  Eigen::Matrix<double, kUnknowns, 1> change = Eigen::Matrix<double, kUnknowns, 1>::Zero();
  change.head<kDiscParameters>() =
      NormalSolver<kDiscParameters>(at.normal.topLeftCorner<kDiscParameters, kDiscParameters>())
          .solve(at.gradient.head<kDiscParameters>());
  return change;
}

bool ShadedDisc::descend(int steps) {
  for (int k = 0; k < steps; ++k) {
    if (!(system().count > unknowns())) return false;
    Eigen::Matrix<double, kUnknowns, 1> change = step();
    const double moved = std::sqrt(change.head<3>().squaredNorm()), most = 0.4 * p_[kDiscRadius];
    if (!(moved < 1e6)) return false;
    if (moved > most) change *= most / moved;
    for (int i = 0; i < kDiscParameters; ++i)
      p_[static_cast<std::size_t>(i)] += static_cast<float>(change[i]);
    brightness_.ratio += static_cast<float>(change[kRatio]);
    brightness_.around += static_cast<float>(change[kSecondAround]);
    is_current_ = false;
    if (!(p_[kDiscRadius] > kSmallestDisc)) return false;
    if (k > 1 && moved < kSettled) break;
  }
  return true;
}

double ShadedDisc::noise() {
  system();
  if (!noise_) noise_ = noiseAround(*window_.colour, window_.room);
  return *noise_;
}

bool ShadedDisc::fitsEverywhere() {
  // Where the whole ball fits badly, the scatter of all cells would excuse it; around it there is noise
  // alone.
  const double scale = noise();
  return system_.squares < kLongTail * scale * scale * system_.count;
}

double ShadedDisc::motionInResiduals() {
  const DiscCells& cells = *window_.colour;
  const double x = p_[kDiscX], y = p_[kDiscY], radius = p_[kDiscRadius], scale = noise();
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
  return (by_cosine * by_cosine + by_sine * by_sine) / (0.5 * scale * scale * std::max(1e-9, weights));
}

void ShadedDisc::leaveOutHidden() {
  system();
  is_current_ = false;
  DiscCells& cells = *window_.colour;
  const float around = p_[kDiscAround];
  for (std::size_t i = 0; i < window_.real_count; ++i) {
    const float expected = cells.value[i] - cells.residual[i] - around;
    cells.given[i] = window_.givenAt(cells.x[i], cells.y[i]);
    window_.is_marked[i] = cells.cover[i] > 0.5F && cells.value[i] - around < 0.5F * expected ? 1 : 0;
  }
  for (std::size_t i = 0; i < window_.real_count; ++i)
    if (window_.is_marked[i] != 0) window_.leaveOut(i, cells);
}

ShadedDisc::Quality ShadedDisc::quality() {
  const System& at = system();
  Quality quality;
  quality.variance = std::max(kLeastVariance, at.squares / std::max(1.0, at.count - unknowns()));
  quality.covariance =
      quality.variance *
      (hasBrightness()
           ? NormalSolver<kUnknowns>(at.normal).firstTwo()
           : NormalSolver<kDiscParameters>(at.normal.topLeftCorner<kDiscParameters, kDiscParameters>())
                 .firstTwo());
  return quality;
}

double ShadedDisc::seenCells() const {
  const DiscCells& cells = *window_.colour;
  double seen = 0.0;
  for (std::size_t i = 0; i < window_.real_count; ++i)
    if (window_.is_marked[i] == 0 && window_.givenAt(cells.x[i], cells.y[i]) != 0.0F) seen += cells.cover[i];
  return seen;
}

}  // namespace helical
