#include "engine/simulator/scene_room.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

namespace helical {
namespace {

using Eigen::Vector2f;
using Eigen::Vector3f;

constexpr float kHalfWidth = 3.4F;  ///< m, of the room
constexpr float kHeight = 2.8F;
constexpr float kFar = std::numeric_limits<float>::infinity();
const Vector3f kLamp(0.7F, -0.5F, 2.7F);

struct Box {
  Vector3f low;
  Vector3f high;
  Vector3f bgr;
};

const std::array<Box, 9> kFurniture{{
    {{-2.35F, 1.45F, 0.0F}, {-1.85F, 1.95F, 0.42F}, {92, 122, 150}},    // cardboard
    {{-2.30F, 1.50F, 0.42F}, {-1.98F, 1.80F, 0.66F}, {100, 132, 160}},  // smaller one on it
    {{-1.35F, 2.15F, 0.0F}, {-0.90F, 2.40F, 0.22F}, {62, 62, 128}},     // tool box
    {{-2.90F, 2.95F, 0.0F}, {-0.60F, 3.38F, 1.30F}, {128, 120, 112}},   // cupboard
    {{-2.30F, -2.10F, 0.0F}, {-1.75F, -1.60F, 0.46F}, {104, 96, 88}},   // stool
    {{-1.05F, -2.70F, 0.0F}, {-0.35F, -2.20F, 0.55F}, {118, 92, 76}},   // crate
    {{2.55F, -1.30F, 0.0F}, {3.38F, 0.15F, 0.95F}, {142, 134, 126}},    // cabinet
    {{2.20F, 0.75F, 0.0F}, {2.62F, 1.20F, 0.36F}, {88, 118, 148}},      // cardboard
    {{-3.38F, -1.10F, 0.0F}, {-2.95F, 0.90F, 0.80F}, {96, 112, 128}},   // sideboard
}};

float hash(std::int32_t x, std::int32_t y) {
  auto h = static_cast<std::uint32_t>(x) * 0x8da6b343U ^ static_cast<std::uint32_t>(y) * 0xd8163841U;
  h = (h ^ h >> 15) * 0x2c1b3c6dU;
  h = (h ^ h >> 12) * 0x297a2d39U;
  return static_cast<float>((h ^ h >> 15) >> 8) * 0x1p-24F;
}

/// Smooth random surface between 0 and 1 with features one unit wide.
float valueNoise(float x, float y) {
  const float fx = std::floor(x), fy = std::floor(y);
  const auto ix = static_cast<std::int32_t>(fx), iy = static_cast<std::int32_t>(fy);
  float u = x - fx, v = y - fy;
  u *= u * (3.0F - 2.0F * u);
  v *= v * (3.0F - 2.0F * v);
  const float top = hash(ix, iy) * (1.0F - u) + hash(ix + 1, iy) * u;
  const float bottom = hash(ix, iy + 1) * (1.0F - u) + hash(ix + 1, iy + 1) * u;
  return top * (1.0F - v) + bottom * v;
}

/// How much of a pixel's footprint on the floor lies inside an edge that is `depth` [m] away: thin lines
/// would look dotted otherwise.
float inside(float depth) {
  constexpr float kFootprint = 0.006F;
  return std::clamp(depth / kFootprint + 0.5F, 0.0F, 1.0F);
}

Vector3f planks(float x, float y) {
  constexpr float kWidth = 0.13F, kLength = 1.4F, kHalfSeam = 0.0015F;
  const auto row = static_cast<std::int32_t>(std::floor(y / kWidth));
  const float along = x + kLength * hash(row, 77);
  const auto column = static_cast<std::int32_t>(std::floor(along / kLength));
  const float across = y - kWidth * static_cast<float>(row);
  const float lengthwise = along - kLength * static_cast<float>(column);
  const float tone = 0.90F + 0.16F * hash(row, column);
  const float start = 31.0F * hash(column, row);
  const float grain = 0.10F * (valueNoise(2.2F * x + start, 34.0F * y) - 0.5F) +
                      0.07F * (valueNoise(7.0F * x, 110.0F * y + start) - 0.5F);
  const float to_seam =
      std::min(std::min(across, kWidth - across), std::min(lengthwise, kLength - lengthwise));
  return Vector3f(100, 124, 145) * ((tone + grain) * (1.0F - 0.38F * inside(kHalfSeam - to_seam)));
}

/// Letter H with a ring, on a rubber mat; an arrow shows where the nose belongs. `floor` is what lies around
/// it.
Vector3f pad(float x, float y, const Vector3f& floor) {
  const float ring = inside(0.015F - std::abs(std::hypot(x, y) - 0.3F));
  const float posts = std::min(inside(0.15F - std::abs(x)), inside(0.02F - std::abs(std::abs(y) - 0.09F)));
  const float bar = std::min(inside(0.02F - std::abs(x)), inside(0.09F - std::abs(y)));
  const float arrow = std::min(inside(x - 0.335F), inside(0.7F * (0.385F - x - std::abs(y))));
  const float paint = std::max({ring, posts, bar, arrow});
  const float border = std::max(std::abs(x), std::abs(y));
  const Vector3f rubber = Vector3f(78, 76, 74) * (0.95F + 0.1F * valueNoise(120.0F * x, 120.0F * y)) *
                          (1.0F - 0.2F * inside(border - 0.405F));
  const Vector3f mat = rubber + paint * (Vector3f(196, 198, 200) - rubber);
  return mat + inside(border - 0.42F) * (floor - mat);
}

/// Darkening of the floor close to what stands on it.
float contactShade(float x, float y) {
  float shade = 1.0F;
  for (const Box& box : kFurniture) {
    if (box.low.z() > 0.0F) continue;
    const float dx = std::max({box.low.x() - x, x - box.high.x(), 0.0F});
    const float dy = std::max({box.low.y() - y, y - box.high.y(), 0.0F});
    const float distance2 = dx * dx + dy * dy;
    shade *= 1.0F - 0.40F / (1.0F + distance2 / 0.012F);
  }
  const float wall = kHalfWidth - std::max(std::abs(x), std::abs(y));
  return shade * (1.0F - 0.28F / (1.0F + wall * wall / 0.03F));
}

Vector3f floorColour(float x, float y) {
  const Vector3f wood = planks(x, y) * contactShade(x, y);
  return std::max(std::abs(x), std::abs(y)) < 0.43F ? pad(x, y, wood) : wood;
}

float lampShade(const Vector3f& point, const Vector3f& normal) {
  const Vector3f to_lamp = kLamp - point;
  const float distance2 = to_lamp.squaredNorm();
  const float facing = std::max(0.0F, normal.dot(to_lamp) / std::sqrt(distance2));
  return 0.55F + 0.06F * normal.z() + 0.95F * facing / (1.0F + distance2 / 8.0F);
}

struct Hit {
  float distance = kFar;
  Vector3f normal = Vector3f::UnitZ();
  const Box* box = nullptr;  ///< nothing: the shell of the room
};

void intersectShell(const Vector3f& origin, const Vector3f& direction, Hit& hit) {
  for (int axis = 0; axis < 3; ++axis) {
    if (direction[axis] == 0.0F) continue;
    const bool up = direction[axis] > 0.0F;
    const float plane = axis == 2 ? (up ? kHeight : 0.0F) : (up ? kHalfWidth : -kHalfWidth);
    const float t = (plane - origin[axis]) / direction[axis];
    if (t <= 0.0F || t >= hit.distance) continue;
    hit.distance = t;
    hit.normal = Vector3f::Zero();
    hit.normal[axis] = up ? -1.0F : 1.0F;
  }
}

void intersectBox(const Box& box, const Vector3f& origin, const Vector3f& direction, Hit& hit) {
  float enter = 0.0F, leave = hit.distance;
  int axis_entered = -1;
  for (int axis = 0; axis < 3; ++axis) {
    const float inverse = 1.0F / direction[axis];
    float a = (box.low[axis] - origin[axis]) * inverse, b = (box.high[axis] - origin[axis]) * inverse;
    if (a > b) std::swap(a, b);
    if (a > enter) {
      enter = a;
      axis_entered = axis;
    }
    leave = std::min(leave, b);
  }
  if (axis_entered < 0 || enter >= leave) return;
  hit.distance = enter;
  hit.box = &box;
  hit.normal = Vector3f::Zero();
  hit.normal[axis_entered] = direction[axis_entered] > 0.0F ? -1.0F : 1.0F;
}

Vector3f boxColour(const Box& box, const Vector3f& p, const Vector3f& normal) {
  const Vector2f on_face =
      normal.z() != 0.0F ? Vector2f(p.x(), p.y()) : Vector2f(normal.x() != 0.0F ? p.y() : p.x(), p.z());
  Vector3f colour = box.bgr * (0.95F + 0.10F * valueNoise(9.0F * on_face.x(), 9.0F * on_face.y()));
  const Vector3f inside = (p - box.low).cwiseMin(box.high - p);
  int edges = 0;
  for (int axis = 0; axis < 3; ++axis) edges += inside[axis] < 0.012F ? 1 : 0;
  if (edges >= 2) colour *= 1.10F;
  const float height = box.high.z() - box.low.z();
  if (normal.z() == 0.0F && height > 0.7F) {  // doors
    const float door = on_face.x() / 0.48F - std::floor(on_face.x() / 0.48F);
    if (door < 0.02F) colour *= 0.7F;
    if (door > 0.06F && door < 0.09F && std::abs(p.z() - 0.62F * height) < 0.07F) colour *= 0.55F;
  }
  if (normal.z() == 0.0F) colour *= 1.0F - 0.25F / (1.0F + p.z() * p.z() / 0.01F);
  return colour;
}

Vector3f wallColour(const Vector3f& p, const Vector3f& normal) {
  if (p.z() < 0.09F) return {150, 154, 158};  // skirting board
  const float along = normal.x() != 0.0F ? p.y() : p.x();
  const float plaster = 0.97F + 0.04F * valueNoise(5.0F * along, 5.0F * p.z()) +
                        0.02F * valueNoise(40.0F * along, 40.0F * p.z());
  const float corner = kHalfWidth - std::abs(along);
  const float shade = (1.0F - 0.22F / (1.0F + corner * corner / 0.04F)) *
                      (1.0F - 0.15F / (1.0F + (p.z() - 0.09F) * (p.z() - 0.09F) / 0.02F));
  return Vector3f(186, 188, 190) * (plaster * shade);
}

}  // namespace

Eigen::Vector3d lampDirection() {
  return kLamp.cast<double>().normalized();
}

SceneColour roomColour(const Eigen::Vector3d& origin_in, const Eigen::Vector3d& direction_in) {
  const Vector3f origin = origin_in.cast<float>(), direction = direction_in.cast<float>();
  Hit hit;
  intersectShell(origin, direction, hit);
  for (const Box& box : kFurniture) intersectBox(box, origin, direction, hit);
  SceneColour colour;
  if (hit.distance == kFar) return colour;
  const Vector3f p = origin + hit.distance * direction;
  colour.is_floor = hit.box == nullptr && hit.normal.z() > 0.0F;
  if (hit.box != nullptr)
    colour.bgr = boxColour(*hit.box, p, hit.normal);
  else if (!colour.is_floor)
    colour.bgr = hit.normal.z() < 0.0F ? Vector3f(196, 196, 196) : wallColour(p, hit.normal);
  else
    colour.bgr = floorColour(p.x(), p.y());
  colour.bgr *= lampShade(p, hit.normal);
  return colour;
}

}  // namespace helical
