#include "engine/markers/ball_window.h"

#include <algorithm>
#include <cmath>

#include "engine/geometry/rotation.h"
#include "engine/markers/disc_normal.h"

namespace helical {
namespace {

constexpr int kMargin = 3;             ///< cells around the region's box
constexpr double kReach = 2.5;         ///< cells outside of the region's box that are fitted, too
constexpr double kLeastChroma = 12.0;  ///< levels: below, a ball is told by its brightness
const Eigen::Vector3d kGrey = Eigen::Vector3d::Constant(0.5773502691896258);

/// Directions of the rays: the corners of a polygon, by Pythagorean half angles, without trigonometry.
constexpr auto kDirections = [] {
  std::array<std::array<double, 2>, kOutlineRays> directions{};
  constexpr std::array<double, 6> kCos{1.0, 0.9659258262890683, 0.8660254037844387, 0.7071067811865476,
                                       0.5, 0.25881904510252074};
  for (std::size_t i = 0; i < kOutlineRays; ++i) {
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

}  // namespace

float medianOf(std::span<float> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

BallWindow::BallWindow() : colour(std::make_unique<DiscCells>()), brightness(std::make_unique<DiscCells>()) {}

bool BallWindow::read(const CellGrid& grid, const Region& of) {
  left = std::max(0, of.left - kMargin);
  top = std::max(0, of.top - kMargin);
  width = std::min(grid.width - 1, of.right + kMargin) - left + 1;
  height = std::min(grid.height - 1, of.bottom + kMargin) - top + 1;
  if (width < 2 || height < 2 || width > kLargestSide || height > kLargestSide) return false;
  region = of;
  const auto area = static_cast<double>(of.area);
  binary = {{static_cast<double>(of.sum_x) / area - left, static_cast<double>(of.sum_y) / area - top},
            std::sqrt(area / kPi) + 0.3};
  axis = grid.layout == CellLayout::kBytes ? Eigen::Vector3d::UnitX() : colourAxis(grid);
  has_colour = grid.layout != CellLayout::kBytes && axis != kGrey;
  const double middle_x = 0.5 * (of.left + of.right) - left;
  const double middle_y = 0.5 * (of.top + of.bottom) - top;
  const double reach = 0.5 * std::max(of.right - of.left, of.bottom - of.top) + 0.5 + kReach;
  std::array<std::uint8_t, 3> cell{};
  DiscCells& cells = *colour;
  cells.count = 0;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      readCell(grid, left + x, top + y, cell.data());
      const auto value = static_cast<float>(axis[0] * cell[0] + axis[1] * cell[1] + axis[2] * cell[2]);
      values_[static_cast<std::size_t>(y * width + x)] = value;
      const double dx = x - middle_x, dy = y - middle_y;
      if (dx * dx + dy * dy > reach * reach) continue;
      const std::size_t i = cells.count++;
      cells.x[i] = static_cast<float>(x);
      cells.y[i] = static_cast<float>(y);
      cells.value[i] = value;
      cells.given[i] = givenAt(x, y);
      brightness->value[i] = static_cast<float>(kGrey[0] * (cell[0] + cell[1] + cell[2]));
    }
  real_count = cells.count;
  is_marked.fill(0);
  for (; cells.count % kDiscLanes != 0; ++cells.count) {
    cells.x[cells.count] = cells.y[cells.count] = cells.value[cells.count] = 0.0F;
    cells.given[cells.count] = brightness->value[cells.count] = 0.0F;
  }
  return true;
}

Eigen::Vector3d BallWindow::colourAxis(const CellGrid& grid) const {
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
  return kGrey;
}

double BallWindow::valueAt(double x, double y) const {
  const int i = std::clamp(static_cast<int>(x), 0, width - 2),
            j = std::clamp(static_cast<int>(y), 0, height - 2);
  const double a = std::clamp(x - i, 0.0, 1.0), b = std::clamp(y - j, 0.0, 1.0);
  const float* v = values_.data() + j * width + i;
  return (1.0 - b) * ((1.0 - a) * v[0] + a * v[1]) + b * ((1.0 - a) * v[width] + a * v[width + 1]);
}

ValueWindow BallWindow::values() {
  std::size_t count = 0;
  const auto size = static_cast<std::size_t>(width * height), area = static_cast<std::size_t>(region.area);
  std::copy_n(values_.begin(), size, sorted.begin());
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(size - std::max<std::size_t>(1, area / 2));
  std::nth_element(sorted.begin(), middle, sorted.begin() + static_cast<std::ptrdiff_t>(size));
  const float ball = *middle;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      if (x == 0 || y == 0 || x == width - 1 || y == height - 1)
        sorted[count++] = values_[static_cast<std::size_t>(y * width + x)];
  const float around = medianOf(std::span(sorted.data(), count));
  return {values_.data(), width, height, 0.5F * (ball + around), 0.5F * (ball - around)};
}

float BallWindow::givenAt(double x, double y) const {
  if (!neighbour) return 1.0F;
  const double dx = left + x - neighbour->centre.x, dy = top + y - neighbour->centre.y,
               reach = neighbour->radius + 1.0;
  return dx * dx + dy * dy < reach * reach ? 0.0F : 1.0F;
}

std::size_t BallWindow::placeOf(std::size_t cell) const {
  return static_cast<std::size_t>(colour->y[cell]) * static_cast<std::size_t>(width) +
         static_cast<std::size_t>(colour->x[cell]);
}

float BallWindow::noiseAround() {
  std::size_t count = 0;
  for (std::size_t i = 0; i < real_count; ++i)
    if (colour->given[i] != 0.0F && colour->cover[i] == 0.0F) sorted[count++] = std::abs(colour->residual[i]);
  return count > 0 ? std::max(kLeastScale, 1.4826F * medianOf(std::span(sorted.data(), count))) : kLeastScale;
}

float BallWindow::residualScale(const DiscCells& cells) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < cells.count; ++i)
    if (cells.given[i] != 0.0F) sorted[count++] = std::abs(cells.residual[i]);
  return std::max(kLeastScale, 1.4826F * medianOf(std::span(sorted.data(), count)));
}

void BallWindow::leaveOutMarked(DiscCells& cells) {
  for (std::size_t i = 0; i < real_count; ++i) {
    const auto x = static_cast<int>(colour->x[i]), y = static_cast<int>(colour->y[i]);
    // The neighbours of a hidden cell are partly hidden.
    for (int ny = std::max(0, y - 1); ny <= std::min(height - 1, y + 1); ++ny)
      for (int nx = std::max(0, x - 1); nx <= std::min(width - 1, x + 1); ++nx)
        if (is_marked[static_cast<std::size_t>(ny * width + nx)] != 0) cells.given[i] = 0.0F;
  }
}

int BallWindow::traceOutline(double level, std::span<OutlinePoint> outline) const {
  constexpr double kStep = 0.5;
  const double farthest = binary.radius + binary.radius + kMargin;
  int count = 0;
  for (const auto& [nx, ny] : kDirections) {
    double before = valueAt(binary.centre.x, binary.centre.y);
    for (double d = kStep; d < farthest; d += kStep) {
      const double x = binary.centre.x + d * nx, y = binary.centre.y + d * ny;
      if (x < 0.0 || y < 0.0 || x > width - 1 || y > height - 1) break;
      const double here = valueAt(x, y);
      if (before >= level && here < level) {
        const double at = d - kStep + kStep * (before - level) / (before - here);
        outline[static_cast<std::size_t>(count++)] = {binary.centre.x + at * nx, binary.centre.y + at * ny};
        break;
      }
      before = here;
    }
  }
  return count;
}

}  // namespace helical
