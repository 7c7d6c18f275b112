#include "engine/markers/ball_outline.h"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>

namespace helical {
namespace {

constexpr double kRound = 0.4;  ///< cells that a point of a ball's outline may lie off its circle

}  // namespace

int pointsOn(const OutlineCircle& circle, std::span<const OutlinePoint> outline) {
  const double least = std::max(0.0, circle.radius - kRound), most = circle.radius + kRound;
  const double least2 = least * least, most2 = most * most;
  int count = 0;
  for (const OutlinePoint& point : outline) {  // without branches, which nobody could predict
    const double dx = point.x - circle.centre.x, dy = point.y - circle.centre.y, d2 = dx * dx + dy * dy;
    count += static_cast<int>(d2 > least2) & static_cast<int>(d2 < most2);
  }
  return count;
}

OutlineCircle throughPointsOn(const OutlineCircle& circle, std::span<const OutlinePoint> outline) {
  // x^2 + y^2 + a x + b y + c = 0, least squares (Kasa).
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (const OutlinePoint& point : outline) {
    if (pointsOn(circle, {&point, 1}) == 0) continue;
    const Eigen::Vector3d row(point.x - circle.centre.x, point.y - circle.centre.y, 1.0);
    normal += row * row.transpose();
    right -= row * row.head<2>().squaredNorm();
  }
  const Eigen::Vector3d solved = normal.ldlt().solve(right);
  const double x = -0.5 * solved[0], y = -0.5 * solved[1], r2 = x * x + y * y - solved[2];
  if (!(x * x + y * y < 1.0 && r2 > 0.0)) return circle;
  return {{circle.centre.x + x, circle.centre.y + y}, std::sqrt(r2)};
}

std::optional<OutlineCircle> circleThrough(const OutlinePoint& a, const OutlinePoint& b,
                                           const OutlinePoint& c) {
  const double bx = b.x - a.x, by = b.y - a.y, cx = c.x - a.x, cy = c.y - a.y;
  const double cross = 2.0 * (bx * cy - by * cx), b2 = bx * bx + by * by, c2 = cx * cx + cy * cy;
  if (std::abs(cross) < 0.5) return std::nullopt;
  const double ux = (cy * b2 - by * c2) / cross, uy = (bx * c2 - cx * b2) / cross;
  return OutlineCircle{{a.x + ux, a.y + uy}, std::sqrt(ux * ux + uy * uy)};
}

std::optional<OutlineCircle> bestCircle(std::span<const OutlinePoint> outline, double radius) {
  std::optional<OutlineCircle> best;
  int most = 0;
  const std::size_t n = outline.size();
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t apart = 3; 2 * apart < n && apart <= 8; ++apart) {
      const OutlinePoint &a = outline[i], &b = outline[(i + apart) % n], &c = outline[(i + 2 * apart) % n];
      const auto circle = circleThrough(a, b, c);
      if (!circle || circle->radius < 0.8 * radius || circle->radius > 2.0 * radius) continue;
      const int count = pointsOn(*circle, outline);
      if (count <= most) continue;
      most = count;
      best = circle;
    }
  return best ? throughPointsOn(*best, outline) : best;
}

}  // namespace helical
