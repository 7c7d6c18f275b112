#include "tests/markers/ball_picture.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace helical::test {
namespace {

using Colour = std::array<double, 3>;

Colour sampleAt(const BallPicture& ball, double x, double y) {
  constexpr Colour kWall{105, 110, 115}, kBall{60, 200, 50}, kDark{40, 40, 40};
  const double u = (x - ball.x) / ball.radius, v = (y - ball.y) / ball.radius, d2 = u * u + v * v;
  const double towards =
      (x - ball.x) * std::cos(ball.hidden_side) + (y - ball.y) * std::sin(ball.hidden_side);
  if (towards > ball.hidden_from) return kDark;
  if (d2 >= 1.0) return kWall;
  const double facing = std::max(0.0, 0.8 * std::sqrt(1.0 - d2) - 0.4 * v - 0.2 * u);
  const double light = 1.0 - ball.shading + ball.shading * facing;
  return {light * kBall[0], light * kBall[1], light * kBall[2]};
}

}  // namespace

std::vector<double> lightOf(const BallPicture& ball) {
  const double length = std::hypot(ball.way_x, ball.way_y);
  const int moments = 1 + static_cast<int>(std::ceil(2.0 * length));
  const int samples = moments == 1 ? 16 : std::max(4, 16 / moments);  // each way
  const auto side = static_cast<std::size_t>(ball.side);
  std::vector<double> light(3 * side * side);
  for (int moment = 0; moment < moments; ++moment) {
    BallPicture there = ball;
    const double at = (moment + 0.5) / moments - 0.5;
    there.x += at * ball.way_x;
    there.y += at * ball.way_y;
    for (int y = 0; y < ball.side; ++y)
      for (int x = 0; x < ball.side; ++x) {
        double* pixel = &light[3 * (static_cast<std::size_t>(y) * side + static_cast<std::size_t>(x))];
        const bool is_even =
            std::hypot(x - there.x, y - there.y) > ball.radius + 1.0 && ball.hidden_from > 1e8;
        const int n = is_even ? 1 : samples;
        for (int j = 0; j < n; ++j)
          for (int i = 0; i < n; ++i) {
            const Colour c = sampleAt(there, x - 0.5 + (i + 0.5) / n, y - 0.5 + (j + 0.5) / n);
            for (std::size_t k = 0; k < 3; ++k) pixel[k] += c[k] / (n * n * moments);
          }
      }
  }
  return light;
}

Picture exposed(const std::vector<double>& light, int side, double noise, Random& random) {
  Picture picture(side, side);
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x)
      for (int k = 0; k < 3; ++k) {
        const double level = light[static_cast<std::size_t>(3 * (y * side + x) + k)];
        picture.pixel(x, y)[k] =
            static_cast<std::uint8_t>(std::clamp(std::lround(level + noise * random.normal()), 0L, 255L));
      }
  return picture;
}

Picture drawBall(const BallPicture& ball, double noise, Random& random) {
  return exposed(lightOf(ball), ball.side, noise, random);
}

}  // namespace helical::test
