#include "engine/markers/ball_window.h"

#include <algorithm>
#include <cmath>

#include "engine/geometry/rotation.h"
#include "engine/markers/cell_scatter.h"

namespace helical {
namespace {

constexpr int kMargin = 3;         ///< cells around the region's box
constexpr double kOutline = 1.25;  ///< cells on either side of the outline, of which the disc covers a part
constexpr double kReach = 2.5;     ///< cells outside of the region's box that are fitted, too
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

/// Of a row of cells: from the first to the one before the other.
struct Chord {
  int from = 0, to = 0;

  /// What lies within `reach` of the place `middle` of a row of that width, which is `dy` beside it.
  static Chord of(double reach, double dy, double middle, int width) {
    const double square = reach * reach - dy * dy;
    if (!(reach > 0.0 && square >= 0.0)) return {};
    const double half = std::sqrt(square);
    const int from = std::max(0, static_cast<int>(std::ceil(middle - half)));
    return {from, std::max(from, std::min(width, static_cast<int>(std::floor(middle + half)) + 1))};
  }
};

}  // namespace

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
  readValues(grid);
  findLevels();
  const double radius = binary.radius,
               reach = 0.5 * std::max(of.right - of.left, of.bottom - of.top) + 0.5 + kReach;
  colour->count = 0;
  std::fill_n(cell_at_.begin(), width * height, std::int16_t{-1});
  addRing(0.0, radius - kOutline);
  addRing(radius - kOutline, std::min(reach, radius + kOutline));
  addRing(radius + kOutline, reach);
  real_count = colour->count;
  std::fill_n(is_marked.begin(), real_count, std::uint8_t{0});
  for (; colour->count % kDiscLanes != 0; ++colour->count)
    for (DiscCells* cells : {colour.get(), brightness.get()})
      for (auto* values : {&cells->x, &cells->y, &cells->value, &cells->given})
        (*values)[colour->count] = 0.0F;
  return true;
}

void BallWindow::readValues(const CellGrid& grid) {
  const Eigen::Vector3f along = axis.cast<float>();
  const auto grey = static_cast<float>(kGrey[0]);
  const bool is_plain = grid.layout == CellLayout::kTriples;
  std::array<std::uint8_t, std::size_t{3} * kLargestSide> row{};
  for (int y = 0; y < height; ++y) {
    const std::uint8_t* cells = is_plain ? grid.row(top + y) + std::ptrdiff_t{3} * left : row.data();
    if (!is_plain)
      for (int x = 0; x < width; ++x)
        readCell(grid, left + x, top + y, &row[static_cast<std::size_t>(3 * x)]);
    float* values = &values_[static_cast<std::size_t>(y * width)];
    float* greys = &brightness_[static_cast<std::size_t>(y * width)];
    for (int x = 0; x < width; ++x) {
      const auto first = static_cast<float>(cells[3 * x]), second = static_cast<float>(cells[3 * x + 1]),
                 third = static_cast<float>(cells[3 * x + 2]);
      values[x] = along[0] * first + along[1] * second + along[2] * third;
      greys[x] = grey * (first + second + third);
    }
  }
}

void BallWindow::addRing(double from, double to) {
  const double middle_x = 0.5 * (region.left + region.right) - left,
               middle_y = 0.5 * (region.top + region.bottom) - top;
  for (int y = 0; y < height; ++y) {
    const Chord all = Chord::of(to, y - middle_y, middle_x, width);
    const Chord inner = Chord::of(from, y - middle_y, middle_x, width);
    const bool is_split = inner.to > inner.from;
    addCells(y, all.from, is_split ? inner.from : all.to);
    if (is_split) addCells(y, inner.to, all.to);
  }
}

void BallWindow::addCells(int y, int from, int to) {
  for (int x = from; x < to; ++x) {
    const auto place = static_cast<std::size_t>(y * width + x);
    const std::size_t i = colour->count++;
    cell_at_[place] = static_cast<std::int16_t>(i);
    colour->x[i] = static_cast<float>(x);
    colour->y[i] = static_cast<float>(y);
    colour->value[i] = values_[place];
    colour->given[i] = givenAt(x, y);
    brightness->value[i] = brightness_[place];
  }
}

void BallWindow::findLevels() {
  const auto size = static_cast<std::size_t>(width * height), area = static_cast<std::size_t>(region.area);
  const float ball = valueOfRank({values_.data(), size}, size - std::max<std::size_t>(1, area / 2));
  const auto row = static_cast<std::size_t>(width);
  float* border = std::copy_n(values_.begin(), row, room.begin());
  border = std::copy_n(&values_[size - row], row, border);
  for (std::size_t at = row; at + row < size; at += row) {
    *border++ = values_[at];
    *border++ = values_[at + row - 1];
  }
  const float around = medianOf({room.data(), border});
  level_ = 0.5F * (ball + around);
  contrast_ = 0.5F * (ball - around);
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

float BallWindow::givenAt(double x, double y) const {
  if (!neighbour) return 1.0F;
  const double dx = left + x - neighbour->centre.x, dy = top + y - neighbour->centre.y,
               reach = neighbour->radius + 1.0;
  return dx * dx + dy * dy < reach * reach ? 0.0F : 1.0F;
}

void BallWindow::leaveOut(std::size_t cell, DiscCells& cells) const {
  const auto x = static_cast<int>(colour->x[cell]), y = static_cast<int>(colour->y[cell]);
  for (int ny = std::max(0, y - 1); ny <= std::min(height - 1, y + 1); ++ny)
    for (int nx = std::max(0, x - 1); nx <= std::min(width - 1, x + 1); ++nx)
      if (const int at = cell_at_[static_cast<std::size_t>(ny * width + nx)]; at >= 0)
        cells.given[static_cast<std::size_t>(at)] = 0.0F;
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
