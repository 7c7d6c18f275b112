#include "engine/markers/disc_fit.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace helical {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr int kMargin = 3;             ///< cells around the region's box
constexpr double kReach = 2.5;         ///< cells outside of the region's box that are fitted, too
constexpr double kLeastChroma = 12.0;  ///< levels: below, a ball is told by its brightness
constexpr float kLeastScale = 0.7F;    ///< levels: quantisation and what the model leaves out
constexpr double kLeastContrast = 8.0;
constexpr int kSteps = 6;
constexpr int kRounds = 2;
constexpr double kUnknowns = kDiscParameters;
/// Share of the contrast that residuals may have: a ball with a pattern or smeared by its motion is no shaded
/// disc, and its centre of gravity is the steadier estimate.
constexpr double kWorstMisfit = 0.12;
constexpr double kLongTail = 1.8;  ///< mean square over that of a normal distribution: something does not fit
constexpr double kSettled = 3e-3;  ///< cells: a smaller step is the last
constexpr int kRays = 24;
constexpr double kRound = 0.4;  ///< cells that a point of a ball's outline may lie off its circle

using Normal = Eigen::Matrix<double, kDiscParameters, kDiscParameters>;
using Vector = Eigen::Matrix<double, kDiscParameters, 1>;

/// Directions of the rays: the corners of a polygon, by Pythagorean half angles, without trigonometry.
constexpr auto kDirections = [] {
  std::array<std::array<double, 2>, kRays> directions{};
  constexpr std::array<double, 6> kCos{1.0, 0.9659258262890683, 0.8660254037844387, 0.7071067811865476,
                                       0.5, 0.25881904510252074};
  for (std::size_t i = 0; i < kRays; ++i) {
    double x = kCos[i % 6], y = i % 6 == 0 ? 0.0 : kCos[6 - i % 6];
    for (std::size_t quarter = 0; quarter < i / 6; ++quarter) {
      const double turned = -y;
      y = x;
      x = turned;
    }
    directions[i] = {x, y};
  }
  return directions;
}();

void assemble(const DiscSums& sums, double prior, double light_z, Normal& normal, Vector& gradient) {
  for (int a = 0; a < kDiscParameters; ++a) {
    const auto i = static_cast<std::size_t>(a);
    for (int b = 0; b <= a; ++b) normal(a, b) = normal(b, a) = sums.normal[i][static_cast<std::size_t>(b)];
    normal(a, a) += 1e-9;
    gradient[a] = sums.gradient[i];
  }
  normal(kDiscLightZ, kDiscLightZ) += prior;
  gradient[kDiscLightZ] -= prior * light_z;
}

}  // namespace

DiscFit::DiscFit() : cells_(std::make_unique<DiscCells>()) {}

std::optional<Disc> DiscFit::fit(const CellGrid& grid, const Region& region) {
  if (!readWindow(grid, region)) return std::nullopt;
  start(binary_);
  std::array<Point, kRays> room;
  const std::span outline(room.data(), static_cast<std::size_t>(traceOutline(room)));
  if (descend(kSteps) && isPlausible() && fitsEverywhere()) return result();
  start(bestCircle(outline).value_or(binary_));
  for (int round = 0; round < kRounds; ++round) {
    leaveOutHidden();
    if (!descend(kSteps) || !isPlausible()) return std::nullopt;
  }
  return result();
}

bool DiscFit::readWindow(const CellGrid& grid, const Region& region) {
  left_ = std::max(0, region.left - kMargin);
  top_ = std::max(0, region.top - kMargin);
  width_ = std::min(grid.width - 1, region.right + kMargin) - left_ + 1;
  height_ = std::min(grid.height - 1, region.bottom + kMargin) - top_ + 1;
  if (width_ < 2 || height_ < 2 || width_ > kLargestSide || height_ > kLargestSide) return false;
  const auto area = static_cast<double>(region.area);
  binary_ = {
      {static_cast<double>(region.sum_x) / area - left_, static_cast<double>(region.sum_y) / area - top_},
      std::sqrt(area / kPi) + 0.3};
  const Eigen::Vector3d axis =
      grid.layout == CellLayout::kBytes ? Eigen::Vector3d::UnitX() : colourAxis(grid, region);
  const double middle_x = 0.5 * (region.left + region.right) - left_;
  const double middle_y = 0.5 * (region.top + region.bottom) - top_;
  const double reach = 0.5 * std::max(region.right - region.left, region.bottom - region.top) + 0.5 + kReach;
  std::array<std::uint8_t, 3> cell{};
  DiscCells& cells = *cells_;
  cells.count = 0;
  for (int y = 0; y < height_; ++y)
    for (int x = 0; x < width_; ++x) {
      readCell(grid, left_ + x, top_ + y, cell.data());
      const auto value = static_cast<float>(axis[0] * cell[0] + axis[1] * cell[1] + axis[2] * cell[2]);
      values_[static_cast<std::size_t>(y * width_ + x)] = value;
      const double dx = x - middle_x, dy = y - middle_y;
      if (dx * dx + dy * dy > reach * reach) continue;
      const std::size_t i = cells.count++;
      cells.x[i] = static_cast<float>(x);
      cells.y[i] = static_cast<float>(y);
      cells.value[i] = value;
      cells.given[i] = 1.0F;
    }
  real_count_ = cells.count;
  is_hidden_.fill(0);
  for (; cells.count % kDiscLanes != 0; ++cells.count) {
    cells.x[cells.count] = cells.y[cells.count] = cells.value[cells.count] = 0.0F;
    cells.given[cells.count] = 0.0F;
  }
  return true;
}

Eigen::Vector3d DiscFit::colourAxis(const CellGrid& grid, const Region& region) const {
  // The middle of the region: cells that are the ball's alone.
  const auto x = static_cast<int>(region.sum_x / region.area),
             y = static_cast<int>(region.sum_y / region.area);
  const int reach = std::min(region.right - region.left, region.bottom - region.top) / 4;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  std::array<std::uint8_t, 3> cell{};
  int count = 0;
  for (int j = std::max(0, y - reach); j <= std::min(grid.height - 1, y + reach); ++j)
    for (int i = std::max(0, x - reach); i <= std::min(grid.width - 1, x + reach); ++i, ++count) {
      readCell(grid, i, j, cell.data());
      sum += Eigen::Vector3d(cell[0], cell[1], cell[2]);
    }
  const Eigen::Vector3d mean = sum / count, chroma = mean - Eigen::Vector3d::Constant(mean.sum() / 3.0);
  if (chroma.squaredNorm() >= kLeastChroma * kLeastChroma) return chroma / std::sqrt(chroma.squaredNorm());
  return Eigen::Vector3d::Constant(1.0 / std::sqrt(3.0));
}

double DiscFit::valueAt(double x, double y) const {
  const int i = std::clamp(static_cast<int>(x), 0, width_ - 2),
            j = std::clamp(static_cast<int>(y), 0, height_ - 2);
  const double a = std::clamp(x - i, 0.0, 1.0), b = std::clamp(y - j, 0.0, 1.0);
  const float* v = values_.data() + j * width_ + i;
  return (1.0 - b) * ((1.0 - a) * v[0] + a * v[1]) + b * ((1.0 - a) * v[width_] + a * v[width_ + 1]);
}

void DiscFit::start(const Circle& circle) {
  const DiscCells& cells = *cells_;
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

float DiscFit::residualScale() {
  const DiscCells& cells = *cells_;
  std::size_t count = 0;
  for (std::size_t i = 0; i < cells.count; ++i)
    if (cells.given[i] != 0.0F) sorted_[count++] = std::abs(cells.residual[i]);
  const auto middle = sorted_.begin() + static_cast<std::ptrdiff_t>(count / 2);
  std::nth_element(sorted_.begin(), middle, sorted_.begin() + static_cast<std::ptrdiff_t>(count));
  return std::max(kLeastScale, 1.4826F * *middle);
}

bool DiscFit::fitsEverywhere() {
  DiscSums sums;
  evaluateDisc(p_, true, *cells_);
  weighDisc(0.0F, *cells_);
  sumDisc(*cells_, sums);
  const double scale = residualScale();
  return sums.squares < kLongTail * scale * scale * sums.weight;
}

void DiscFit::leaveOutHidden() {
  DiscCells& cells = *cells_;
  evaluateDisc(p_, true, cells);
  is_hidden_.fill(0);
  const float around = p_[kDiscAround];
  const auto cellAt = [&](std::size_t i) {
    return static_cast<std::ptrdiff_t>(cells.y[i]) * width_ + static_cast<std::ptrdiff_t>(cells.x[i]);
  };
  for (std::size_t i = 0; i < real_count_; ++i) {
    const float expected = cells.value[i] - cells.residual[i] - around;
    if (cells.cover[i] > 0.5F && cells.value[i] - around < 0.5F * expected)
      is_hidden_[static_cast<std::size_t>(cellAt(i))] = 1;
  }
  for (std::size_t i = 0; i < real_count_; ++i) {
    const auto x = static_cast<int>(cells.x[i]), y = static_cast<int>(cells.y[i]);
    cells.given[i] = 1.0F;
    // The neighbours of a hidden cell are partly hidden.
    for (int ny = std::max(0, y - 1); ny <= std::min(height_ - 1, y + 1); ++ny)
      for (int nx = std::max(0, x - 1); nx <= std::min(width_ - 1, x + 1); ++nx)
        if (is_hidden_[static_cast<std::size_t>(ny * width_ + nx)] != 0) cells.given[i] = 0.0F;
  }
}

bool DiscFit::descend(int steps) {
  DiscSums sums;
  Normal normal;
  Vector gradient;
  weighDisc(0.0F, *cells_);
  for (int step = 0; step < steps; ++step) {
    evaluateDisc(p_, step > 0, *cells_);
    sumDisc(*cells_, sums);
    if (!(sums.weight > kUnknowns)) return false;
    const double ambient = p_[kDiscAmbient];
    assemble(sums, 4.0 / (1.0 + ambient * ambient), p_[kDiscLightZ], normal, gradient);
    Vector change = normal.ldlt().solve(gradient);
    const double moved = std::sqrt(change.head<3>().squaredNorm()), most = 0.4 * p_[kDiscRadius];
    if (!(moved < 1e6)) return false;
    if (moved > most) change *= most / moved;
    for (int k = 0; k < kDiscParameters; ++k)
      p_[static_cast<std::size_t>(k)] += static_cast<float>(change[k]);
    if (!(p_[kDiscRadius] > 0.7F)) return false;
    if (step > 1 && moved < kSettled) break;
  }
  return true;
}

std::optional<Disc> DiscFit::result() {
  DiscCells& cells = *cells_;
  evaluateDisc(p_, true, cells);
  weighDisc(0.0F, cells);
  DiscSums sums;
  sumDisc(cells, sums);
  double seen = 0.0;
  for (std::size_t i = 0; i < real_count_; ++i)
    if (is_hidden_[static_cast<std::size_t>(cells.y[i]) * static_cast<std::size_t>(width_) +
                   static_cast<std::size_t>(cells.x[i])] == 0)
      seen += cells.cover[i];
  Normal normal;
  Vector gradient;
  assemble(sums, 4.0 / (1.0 + p_[kDiscAmbient] * p_[kDiscAmbient]), p_[kDiscLightZ], normal, gradient);
  const double least = 0.25 * kLeastScale * kLeastScale;
  const double variance = std::max(least, sums.squares / std::max(1.0, sums.weight - kUnknowns));
  const double contrast = p_[kDiscAmbient] + std::max(0.0F, p_[kDiscLightZ]) - p_[kDiscAround];
  if (variance > kWorstMisfit * kWorstMisfit * contrast * contrast) return std::nullopt;
  const Normal inverse = normal.ldlt().solve(Normal::Identity());
  Disc disc;
  disc.centre = {left_ + static_cast<double>(p_[kDiscX]), top_ + static_cast<double>(p_[kDiscY])};
  disc.covariance = variance * inverse.topLeftCorner<2, 2>();
  disc.radius = p_[kDiscRadius];
  // What of the disc lies outside of the fitted cells is hidden, too.
  disc.seen_share = std::clamp(seen / (kPi * disc.radius * disc.radius), 0.0, 1.0);
  const double trace = disc.covariance.trace();
  if (!(trace > 0.0 && trace < disc.radius * disc.radius)) return std::nullopt;
  return disc;
}

int DiscFit::traceOutline(std::span<Point> outline) const {
  constexpr double kStep = 0.5;
  const double level = 0.5 * (p_[kDiscAmbient] + p_[kDiscAround]);
  const double farthest = binary_.radius + binary_.radius + kMargin;
  int count = 0;
  for (const auto& [nx, ny] : kDirections) {
    double before = valueAt(binary_.centre.x, binary_.centre.y);
    for (double d = kStep; d < farthest; d += kStep) {
      const double x = binary_.centre.x + d * nx, y = binary_.centre.y + d * ny;
      if (x < 0.0 || y < 0.0 || x > width_ - 1 || y > height_ - 1) break;
      const double here = valueAt(x, y);
      if (before >= level && here < level) {
        const double at = d - kStep + kStep * (before - level) / (before - here);
        outline[static_cast<std::size_t>(count++)] = {binary_.centre.x + at * nx, binary_.centre.y + at * ny};
        break;
      }
      before = here;
    }
  }
  return count;
}

int DiscFit::agreeing(std::span<const Point> outline, const Circle& circle) const {
  const double least = std::max(0.0, circle.radius - kRound), most = circle.radius + kRound;
  return static_cast<int>(std::count_if(outline.begin(), outline.end(), [&](const Point& point) {
    const double dx = point.x - circle.centre.x, dy = point.y - circle.centre.y, d2 = dx * dx + dy * dy;
    return d2 > least * least && d2 < most * most;
  }));
}

std::optional<DiscFit::Circle> DiscFit::bestCircle(std::span<const Point> outline) const {
  std::optional<Circle> best;
  int most = 0;
  const std::size_t n = outline.size();
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t apart = 3; 2 * apart < n && apart <= 8; ++apart) {
      const Point &a = outline[i], &b = outline[(i + apart) % n], &c = outline[(i + 2 * apart) % n];
      const double bx = b.x - a.x, by = b.y - a.y, cx = c.x - a.x, cy = c.y - a.y;
      const double cross = 2.0 * (bx * cy - by * cx), b2 = bx * bx + by * by, c2 = cx * cx + cy * cy;
      if (std::abs(cross) < 0.5) continue;
      const double ux = (cy * b2 - by * c2) / cross, uy = (bx * c2 - cx * b2) / cross;
      const Circle circle{{a.x + ux, a.y + uy}, std::sqrt(ux * ux + uy * uy)};
      if (circle.radius < 0.8 * binary_.radius || circle.radius > 2.0 * binary_.radius) continue;
      const int count = agreeing(outline, circle);
      if (count <= most) continue;
      most = count;
      best = circle;
    }
  return best ? throughAgreeing(outline, *best) : best;
}

DiscFit::Circle DiscFit::throughAgreeing(std::span<const Point> outline, const Circle& circle) const {
  // x^2 + y^2 + a x + b y + c = 0, least squares (Kasa).
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (const Point& point : outline) {
    if (agreeing({&point, 1}, circle) == 0) continue;
    const Eigen::Vector3d row(point.x - circle.centre.x, point.y - circle.centre.y, 1.0);
    normal += row * row.transpose();
    right -= row * row.head<2>().squaredNorm();
  }
  const Eigen::Vector3d solved = normal.ldlt().solve(right);
  const double x = -0.5 * solved[0], y = -0.5 * solved[1], r2 = x * x + y * y - solved[2];
  if (!(x * x + y * y < 1.0 && r2 > 0.0)) return circle;
  return {{circle.centre.x + x, circle.centre.y + y}, std::sqrt(r2)};
}

bool DiscFit::isPlausible() const {
  const double dx = p_[kDiscX] - binary_.centre.x, dy = p_[kDiscY] - binary_.centre.y;
  const double radius = p_[kDiscRadius],
               contrast = p_[kDiscAmbient] + std::max(0.0F, p_[kDiscLightZ]) - p_[kDiscAround];
  return dx * dx + dy * dy < binary_.radius * binary_.radius && radius > 0.6 * binary_.radius &&
         radius < 2.0 * binary_.radius && contrast > kLeastContrast;
}

}  // namespace helical
