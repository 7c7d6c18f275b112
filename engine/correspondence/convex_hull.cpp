#include "engine/correspondence/convex_hull.h"

#include <algorithm>

#include "engine/base/check.h"

namespace helical {

HullOrder convexHull(std::span<const Eigen::Vector2d> points) {
  HELICAL_CHECK(points.size() <= kMaxHullPoints);
  const int n = static_cast<int>(points.size());
  std::array<std::uint8_t, kMaxHullPoints> order{};
  for (int i = 0; i < n; ++i) order[static_cast<std::size_t>(i)] = static_cast<std::uint8_t>(i);
  std::sort(order.begin(), order.begin() + n, [&](int a, int b) {
    const auto &p = points[static_cast<std::size_t>(a)], &q = points[static_cast<std::size_t>(b)];
    return p.x() != q.x() ? p.x() < q.x() : p.y() < q.y();
  });

  const auto turn = [&](int o, int a, int b) {
    const Eigen::Vector2d u = points[static_cast<std::size_t>(a)] - points[static_cast<std::size_t>(o)];
    const Eigen::Vector2d v = points[static_cast<std::size_t>(b)] - points[static_cast<std::size_t>(o)];
    return u.x() * v.y() - u.y() * v.x();
  };
  std::array<std::uint8_t, 2 * kMaxHullPoints> chain{};
  int k = 0;
  const auto extend = [&](int i, int floor) {
    while (k >= floor + 2 &&
           turn(chain[static_cast<std::size_t>(k - 2)], chain[static_cast<std::size_t>(k - 1)], i) <= 0)
      --k;
    chain[static_cast<std::size_t>(k++)] = static_cast<std::uint8_t>(i);
  };
  for (int i = 0; i < n; ++i) extend(order[static_cast<std::size_t>(i)], 0);
  const int lower = k - 1;
  for (int i = n - 2; i >= 0; --i) extend(order[static_cast<std::size_t>(i)], lower);

  HullOrder hull;
  hull.count = n <= 1 ? n : k - 1;  // the chain ends where it began
  // All points in one place: nothing turns, and the chain went there and back.
  if (hull.count == 2 && points[chain[0]] == points[chain[1]]) hull.count = 1;
  std::copy_n(chain.begin(), hull.count, hull.index.begin());
  return hull;
}

}  // namespace helical
