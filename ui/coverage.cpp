#include "ui/coverage.h"

#include <algorithm>
#include <array>

namespace helical {
namespace {

constexpr double kNearest = 0.05;  // m, in front of the camera
constexpr int kCells = 40;         // each way
constexpr int kBisections = 10;    // to a sixth of a millimetre
constexpr double kUnseen = -1.0;   // px; how far outside does not matter

/// How far inside the image a point is [px]; negative outside.
double margin(const CoveringCamera& camera, const Eigen::Vector3d& point) {
  const Eigen::Vector3d in_camera = camera.camera_from_world * point;
  if (in_camera.z() < kNearest) return kUnseen;
  const auto pixel = camera.model->project(in_camera);
  if (!pixel) return kUnseen;
  const double inside = std::min({pixel->x(), pixel->y(), camera.model->width() - 1.0 - pixel->x(),
                                  camera.model->height() - 1.0 - pixel->y()});
  return inside;
}

/// The margin of the camera that sees the point second best.
double secondBest(const std::vector<CoveringCamera>& cameras, const Eigen::Vector3d& point) {
  double best = kUnseen, second = kUnseen;
  for (const CoveringCamera& camera : cameras) {
    const double m = margin(camera, point);
    second = std::max(second, std::min(m, best));
    best = std::max(best, m);
  }
  return second;
}

struct Corner {
  Eigen::Vector3d point;
  double value = 0.0;
};

/// Where the value passes zero between two corners. Bisected: near a camera it is anything but linear.
Eigen::Vector3d crossing(const std::vector<CoveringCamera>& cameras, const Corner& a, const Corner& b) {
  Eigen::Vector3d in = a.value < 0.0 ? b.point : a.point, out = a.value < 0.0 ? a.point : b.point;
  for (int i = 0; i < kBisections; ++i) {
    const Eigen::Vector3d middle = 0.5 * (in + out);
    (secondBest(cameras, middle) < 0.0 ? out : in) = middle;
  }
  return 0.5 * (in + out);
}

/// Marching squares: the border within one cell.
void addCell(const std::vector<CoveringCamera>& cameras, const std::array<const Corner*, 4>& corners,
             std::vector<Eigen::Vector3d>& lines) {
  std::array<Eigen::Vector3d, 4> crossings;
  std::size_t count = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    const Corner& a = *corners[i];
    const Corner& b = *corners[(i + 1) % 4];
    if ((a.value < 0.0) != (b.value < 0.0)) crossings[count++] = crossing(cameras, a, b);
  }
  for (std::size_t i = 0; i + 1 < count; i += 2) lines.insert(lines.end(), {crossings[i], crossings[i + 1]});
}

}  // namespace

std::vector<Eigen::Vector3d> coverageContours(const std::vector<CoveringCamera>& cameras,
                                              const std::vector<double>& heights, double reach) {
  std::vector<Eigen::Vector3d> lines;
  if (cameras.size() < 2) return lines;
  constexpr std::size_t kCorners = kCells + 1;
  std::vector<Corner> grid(kCorners * kCorners);
  for (const double height : heights) {
    for (std::size_t i = 0; i < grid.size(); ++i) {
      const double x = -reach + 2.0 * reach * static_cast<double>(i % kCorners) / kCells;
      const double y = -reach + 2.0 * reach * static_cast<double>(i / kCorners) / kCells;
      grid[i].point = {x, y, height};
      grid[i].value = secondBest(cameras, grid[i].point);
    }
    for (std::size_t row = 0; row < kCells; ++row)
      for (std::size_t column = 0; column < kCells; ++column) {
        const std::size_t first = row * kCorners + column;
        addCell(cameras,
                {&grid[first], &grid[first + 1], &grid[first + kCorners + 1], &grid[first + kCorners]},
                lines);
      }
  }
  return lines;
}

}  // namespace helical
