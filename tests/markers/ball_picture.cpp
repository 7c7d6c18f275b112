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

Picture drawBall(const BallPicture& ball, double noise, Random& random) {
  constexpr int kSide = 41, kSamples = 16;
  Picture picture(kSide, kSide);
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x) {
      Colour sum{};
      for (int j = 0; j < kSamples; ++j)
        for (int i = 0; i < kSamples; ++i) {
          const Colour c = sampleAt(ball, x - 0.5 + (i + 0.5) / kSamples, y - 0.5 + (j + 0.5) / kSamples);
          for (std::size_t k = 0; k < 3; ++k) sum[k] += c[k] / (kSamples * kSamples);
        }
      for (std::size_t k = 0; k < 3; ++k)
        picture.pixel(x, y)[k] =
            static_cast<std::uint8_t>(std::clamp(std::lround(sum[k] + noise * random.normal()), 0L, 255L));
    }
  return picture;
}

}  // namespace helical::test
