#include "engine/markers/shaded_disc.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/markers/cell_scatter.h"
#include "engine/markers/disc_descent.h"

namespace helical {
namespace {

constexpr double kLongTail = 1.8;  ///< mean square over that of a normal distribution: something does not fit
constexpr double kSettled = 5e-3;  ///< cells: a smaller step is the last
/// Of motions, an eighth of a turn apart.
constexpr std::array<std::array<double, 2>, 8> kAxes{{{1.0, 0.0},
                                                      {0.9238795325112867, 0.3826834323650898},
                                                      {0.7071067811865476, 0.7071067811865476},
                                                      {0.3826834323650898, 0.9238795325112867},
                                                      {0.0, 1.0},
                                                      {-0.3826834323650898, 0.9238795325112867},
                                                      {-0.7071067811865476, 0.7071067811865476},
                                                      {-0.9238795325112867, 0.3826834323650898}}};

constexpr double kUneven = 3.0;       ///< scatter of the brightness over that of the colour that is too much
constexpr float kOutside = 3.5F;      ///< scales: what lies farther off is no noise
constexpr double kSeenOutline = 0.5;  ///< share of the outline that the brightness must show

}  // namespace

double ShadedDisc::contrast() const {
  return p_[kDiscAmbient] + std::max(0.0F, p_[kDiscLightZ]) - p_[kDiscAround];
}

void ShadedDisc::start(const OutlineCircle& circle) {
  // Means over the middle of the disc, and beyond it.
  const DiscCells& cells = *window_.colour;
  const auto x = static_cast<float>(circle.centre.x), y = static_cast<float>(circle.centre.y),
             radius = static_cast<float>(circle.radius);
  float inside = 0.0F, outside = 0.0F, inside_count = 0.0F, outside_count = 0.0F;
  for (std::size_t i = 0; i < cells.count; ++i) {
    const float dx = cells.x[i] - x, dy = cells.y[i] - y, d2 = dx * dx + dy * dy;
    const float in = d2 < 0.4F * radius * radius ? cells.given[i] : 0.0F,
                out = d2 > (radius + 1.0F) * (radius + 1.0F) ? cells.given[i] : 0.0F;
    inside += in * cells.value[i], inside_count += in;
    outside += out * cells.value[i], outside_count += out;
  }
  DiscValues flat{};
  flat[kDiscX] = x;
  flat[kDiscY] = y;
  flat[kDiscRadius] = radius;
  flat[kDiscAmbient] = inside / std::max(1.0F, inside_count);
  flat[kDiscAround] = outside / std::max(1.0F, outside_count);
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
    if (k > 0 && moved < kSettled) break;
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

double ShadedDisc::excess() {
  const double scale = noise();
  return system_.squares / (scale * scale) - system_.count;
}

double ShadedDisc::gainOfMotion() {
  constexpr int kMoments = kSpreadParameters - kDiscParameters;
  const double scale = noise();
  DiscSums sums;
  measureSpreadDisc(p_, *window_.colour, sums);
  const auto all = normalOf<kSpreadParameters>(sums);
  const NormalSolver<kDiscParameters> rest(normalWithPrior<kDiscParameters>(sums, p_[kDiscAmbient]));
  // What the disc at rest cannot explain of the moments' slopes.
  Eigen::Vector3d gradient;
  Eigen::Matrix3d information;
  for (int k = 0; k < kMoments; ++k) {
    const Eigen::Matrix<double, kDiscParameters, 1> by_rest =
        rest.solve(all.col(kDiscParameters + k).head<kDiscParameters>());
    const auto at = static_cast<std::size_t>(kDiscParameters + k);
    gradient[k] = sums.gradient[at];
    for (int i = 0; i < kDiscParameters; ++i)
      gradient[k] -= by_rest[i] * sums.gradient[static_cast<std::size_t>(i)];
    for (int j = 0; j < kMoments; ++j)
      information(j, k) = all(kDiscParameters + j, kDiscParameters + k) -
                          all.col(kDiscParameters + j).head<kDiscParameters>().dot(by_rest);
  }
  double most = 0.0;
  for (const auto& [x, y] : kAxes) {
    const Eigen::Vector3d moments(x * x, x * y, y * y);
    const double towards = moments.dot(gradient), weight = moments.dot(information * moments);
    if (towards > 0.0 && weight > 0.0) most = std::max(most, towards * towards / weight);
  }
  return most / (scale * scale);
}

bool ShadedDisc::leaveOutHidden() {
  system();
  DiscCells& cells = *window_.colour;
  const float around = p_[kDiscAround];
  unsigned changed = 0;
  for (std::size_t i = 0; i < window_.real_count; ++i) {
    const float expected = cells.value[i] - cells.residual[i] - around;
    cells.given[i] = window_.givenAt(cells.x[i], cells.y[i]);
    const std::uint8_t marked = cells.cover[i] > 0.5F && cells.value[i] - around < 0.5F * expected ? 1 : 0;
    changed |= static_cast<unsigned>(marked ^ window_.is_marked[i]);
    window_.is_marked[i] = marked;
  }
  for (std::size_t i = 0; i < window_.real_count; ++i)
    if (window_.is_marked[i] != 0) window_.leaveOut(i, cells);
  is_current_ = is_current_ && changed == 0;
  return changed != 0;
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
