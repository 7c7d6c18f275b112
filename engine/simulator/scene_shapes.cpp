#include "engine/simulator/scene_shapes.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace helical {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::Vector3f;
using Eigen::Vector4f;

constexpr int kPerAxis = SampleStrip::kPerAxis;
constexpr double kNearest = 0.06;  ///< m

PixelRect rectAround(const CameraModel& model, double left, double top, double right, double bottom) {
  const auto bounded = [](double value, int size) {
    return static_cast<int>(std::clamp(value, -2.0, size + 1.0));
  };
  const PixelRect rect{bounded(std::floor(left), model.width()), bounded(std::floor(top), model.height()),
                       bounded(std::ceil(right), model.width()), bounded(std::ceil(bottom), model.height())};
  return rect.clippedTo({0, 0, model.width() - 1, model.height() - 1});
}

/// The samples of one sub-row that lie in a shape's rectangle.
struct SampleRow {
  float* depths;
  Vector4f* colours;
  int count;
  double x;  ///< of the first sample; the next is kStep further
  double y;

  static constexpr double kStep = 1.0 / kPerAxis;
};

template <class Draw>
void forEachRow(SampleStrip& strip, const PixelRect& rect, Draw draw) {
  const PixelRect part = rect.clippedTo(strip.area());
  if (part.isEmpty()) return;
  const std::ptrdiff_t first = (part.left - strip.area().left) * kPerAxis;
  for (int y = part.top; y <= part.bottom; ++y)
    for (int sy = 0; sy < kPerAxis; ++sy)
      draw(SampleRow{strip.depths(y, sy) + first, strip.colours(y, sy) + first,
                     (part.right - part.left + 1) * kPerAxis, part.left + SampleStrip::offset(0),
                     y + SampleStrip::offset(sy)});
}

Vector4f opaque(const Vector3f& bgr) {
  return {bgr.x(), bgr.y(), bgr.z(), 1.0F};
}

float lit(double facing) {
  return 0.50F + 0.58F * static_cast<float>(std::max(0.0, facing));
}

/// Cabin glass, a stripe along the side, white for the rest; `p` is on the unit sphere, x forward and z up.
Vector3f fuselageColour(const Vector3d& p, const Vector3f& base) {
  if (p.x() > 0.28 && p.z() > -0.10) return {58, 48, 42};
  if (std::abs(p.z() + 0.28) < 0.13) return {58, 84, 186};
  return base;
}

}  // namespace

void PixelRect::include(const PixelRect& other) {
  if (other.isEmpty()) return;
  if (isEmpty()) {
    *this = other;
    return;
  }
  left = std::min(left, other.left);
  top = std::min(top, other.top);
  right = std::max(right, other.right);
  bottom = std::max(bottom, other.bottom);
}

PixelRect PixelRect::clippedTo(const PixelRect& other) const {
  return {std::max(left, other.left), std::max(top, other.top), std::min(right, other.right),
          std::min(bottom, other.bottom)};
}

SampleStrip::SampleStrip(int width, int height)
    : depths_(static_cast<std::size_t>(width * kPerAxis) * static_cast<std::size_t>(height * kPerAxis)),
      colours_(depths_.size()) {}

void SampleStrip::start(const PixelRect& area) {
  area_ = area;
  stride_ = (area.right - area.left + 1) * kPerAxis;
  const std::ptrdiff_t count = static_cast<std::ptrdiff_t>(stride_) * (area.bottom - area.top + 1) * kPerAxis;
  std::fill_n(depths_.begin(), count, std::numeric_limits<float>::infinity());
  std::fill_n(colours_.begin(), count, Vector4f::Zero());
}

LocalLens::LocalLens(const CameraModel& model, const Vector2d& at) : pixel(at), bearing(model.bearing(at)) {
  constexpr double kStep = 4.0;
  per_x = (model.bearing(at + Vector2d(kStep, 0)) - model.bearing(at - Vector2d(kStep, 0))) / (2.0 * kStep);
  per_y = (model.bearing(at + Vector2d(0, kStep)) - model.bearing(at - Vector2d(0, kStep))) / (2.0 * kStep);
}

Vector3d LocalLens::ray(double x, double y) const {
  const Vector2d b = bearing + per_x * (x - pixel.x()) + per_y * (y - pixel.y());
  return {b.x(), b.y(), 1.0};
}

std::optional<EllipsoidShape> EllipsoidShape::make(const CameraModel& model, const Vector3d& centre,
                                                   const Eigen::Matrix3d& axes, const Vector3d& radii,
                                                   const Surface& surface) {
  const Vector3d extent = (axes * radii.asDiagonal()).rowwise().norm();
  const double nearest = centre.z() - extent.z();
  const auto pixel = model.project(centre);
  if (!pixel || nearest < kNearest) return std::nullopt;
  EllipsoidShape shape(LocalLens(model, *pixel), surface);
  shape.unit_from_camera_ = radii.cwiseInverse().asDiagonal() * axes.transpose();
  shape.eye_ = -(shape.unit_from_camera_ * centre);
  shape.to_camera_ = -centre.normalized();
  const Vector2d slant = (centre.head<2>() / centre.z()).cwiseAbs();
  const double reach_x = model.fx() * (extent.x() + extent.z() * slant.x()) / nearest * 1.1 + 1.0;
  const double reach_y = model.fy() * (extent.y() + extent.z() * slant.y()) / nearest * 1.1 + 1.0;
  shape.rect_ = rectAround(model, pixel->x() - reach_x, pixel->y() - reach_y, pixel->x() + reach_x,
                           pixel->y() + reach_y);
  return shape;
}

void EllipsoidShape::draw(SampleStrip& strip, const Vector3d& light) const {
  const double c = eye_.squaredNorm() - 1.0;
  const Vector3d step = unit_from_camera_.leftCols<2>() * lens_.per_x * SampleRow::kStep;
  forEachRow(strip, rect_, [&](const SampleRow& row) {
    Vector3d ray = unit_from_camera_ * lens_.ray(row.x, row.y);
    for (int i = 0; i < row.count; ++i, ray += step) {
      const double a = ray.squaredNorm(), b = eye_.dot(ray);
      const double discriminant = b * b - a * c;
      if (discriminant <= 0.0) continue;
      const double depth = (-b - std::sqrt(discriminant)) / a;
      if (depth >= row.depths[i]) continue;
      row.depths[i] = static_cast<float>(depth);
      row.colours[i] = opaque(shade(eye_ + depth * ray, light));
    }
  });
}

Vector3f EllipsoidShape::shade(const Vector3d& unit, const Vector3d& light) const {
  const Vector3d normal = (unit_from_camera_.transpose() * unit).normalized();
  const double facing = normal.dot(light);
  Vector3f colour = surface_.finish == Finish::kFuselage ? fuselageColour(unit, surface_.bgr) : surface_.bgr;
  colour *= lit(facing);
  // The highlight: where the surface mirrors the lamp towards the camera.
  const double mirrored = (2.0 * facing * normal - light).dot(to_camera_);
  if (mirrored > 0.9) {
    const double gloss = (mirrored - 0.9) * 10.0;
    const double strength = surface_.finish == Finish::kBall ? 34.0 : 70.0;
    colour += Vector3f::Constant(static_cast<float>(strength * gloss * gloss));
  }
  return colour;
}

std::optional<RodShape> RodShape::make(const CameraModel& model, const Vector3d& from, const Vector3d& to,
                                       double radius, const Surface& surface) {
  const auto a = model.project(from), b = model.project(to);
  if (!a || !b || std::min(from.z(), to.z()) < kNearest) return std::nullopt;
  RodShape rod;
  rod.from_ = *a;
  rod.along_ = *b - *a;
  rod.axis_ = (to - from).normalized();
  rod.inverse_length2_ = 1.0 / std::max(1e-6, rod.along_.squaredNorm());
  rod.inverse_depth_from_ = 1.0 / from.z();
  rod.inverse_depth_change_ = 1.0 / to.z() - 1.0 / from.z();
  rod.focal_radius_ = 0.5 * (model.fx() + model.fy()) * radius;
  rod.surface_ = surface;
  const double margin = rod.focal_radius_ / std::min(from.z(), to.z()) + 1.0;
  const Vector2d low = a->cwiseMin(*b), high = a->cwiseMax(*b);
  rod.rect_ = rectAround(model, low.x() - margin, low.y() - margin, high.x() + margin, high.y() + margin);
  return rod;
}

void RodShape::draw(SampleStrip& strip, const Vector3d& light) const {
  // In the image: `side` across the rod, `front` towards the camera; both turn a place on the profile into a
  // normal.
  const Vector3d to_camera(0, 0, -1);
  Vector3d front = to_camera - axis_.dot(to_camera) * axis_;
  if (front.squaredNorm() < 1e-6) front = to_camera;
  front.normalize();
  const Vector2d across = Vector2d(-along_.y(), along_.x()) * std::sqrt(inverse_length2_);
  const Vector3d side = Vector3d(across.x(), across.y(), 0.0);
  const double side_facing = side.dot(light), front_facing = front.dot(light);
  const double thickest =
      focal_radius_ * std::max(inverse_depth_from_, inverse_depth_from_ + inverse_depth_change_);
  forEachRow(strip, rect_, [&](const SampleRow& row) {
    // Only samples near the infinite line can be on the rod.
    const double dy = row.y - from_.y();
    double begin = -1e6, end = 1e6;
    if (std::abs(across.x()) > 1e-6) {
      const double middle = from_.x() - across.y() * dy / across.x(), reach = thickest / std::abs(across.x());
      begin = (middle - reach - row.x) / SampleRow::kStep;
      end = (middle + reach - row.x) / SampleRow::kStep;
    } else if (std::abs(dy) > thickest) {
      return;
    }
    const int first = static_cast<int>(std::ceil(std::clamp(begin, 0.0, double(row.count))));
    const int last = static_cast<int>(std::clamp(end, -1.0, row.count - 1.0));
    for (int i = first; i <= last; ++i) {
      const Vector2d d(row.x + i * SampleRow::kStep - from_.x(), dy);
      const double place = std::clamp(d.dot(along_) * inverse_length2_, 0.0, 1.0);
      const double inverse_depth = inverse_depth_from_ + place * inverse_depth_change_;
      const double radius = focal_radius_ * inverse_depth;
      if ((d - place * along_).squaredNorm() > radius * radius) continue;
      const double depth = 1.0 / inverse_depth;
      if (depth >= row.depths[i]) continue;
      const double profile = std::clamp(d.dot(across) / radius, -1.0, 1.0);
      const double facing = profile * side_facing + std::sqrt(1.0 - profile * profile) * front_facing;
      row.depths[i] = static_cast<float>(depth);
      row.colours[i] = opaque(surface_.bgr * lit(facing));
    }
  });
}

std::optional<RotorShape> RotorShape::make(const CameraModel& model, const Vector3d& centre,
                                           const Vector3d& normal, const Vector3d& blade, double radius,
                                           const Surface& surface) {
  const auto pixel = model.project(centre);
  if (!pixel || centre.z() - radius < kNearest) return std::nullopt;
  RotorShape rotor{LocalLens(model, *pixel)};
  rotor.centre_ = centre;
  rotor.normal_ = normal;
  rotor.blade_ = blade;
  rotor.radius_ = radius;
  rotor.pixel_size_ = centre.z() / model.fx();
  rotor.surface_ = surface;
  // How far the disc reaches along the image's axes, and a margin for perspective.
  const Vector2d slant = (centre.head<2>() / centre.z()).cwiseAbs();
  const Vector3d extent = radius * (Vector3d::Ones() - normal.cwiseAbs2()).cwiseMax(0.0).cwiseSqrt();
  const double scale = 1.02 / (centre.z() - extent.z());
  const double reach_x = model.fx() * (extent.x() + extent.z() * slant.x()) * scale + 2.0;
  const double reach_y = model.fy() * (extent.y() + extent.z() * slant.y()) * scale + 2.0;
  rotor.rect_ = rectAround(model, pixel->x() - reach_x, pixel->y() - reach_y, pixel->x() + reach_x,
                           pixel->y() + reach_y);
  return rotor;
}

double RotorShape::opacityAt(const Vector3d& from_hub) const {
  const double r2 = from_hub.squaredNorm();
  const double outermost = radius_ + 0.5 * pixel_size_;
  if (r2 >= outermost * outermost) return 0.0;
  const double r = std::sqrt(r2);
  const double edge = std::min(1.0, (outermost - r) / pixel_size_);
  const double along = from_hub.dot(blade_);
  const double smear = std::max(0.0, along * along / std::max(r2, 1e-9) - 0.62) / 0.38;
  const double tip = std::max(0.0, r / radius_ - 0.93) / 0.07;
  return edge * (0.10 + 0.22 * smear + 0.20 * std::min(1.0, tip));
}

void RotorShape::draw(SampleStrip& strip) const {
  const PixelRect part = rect_.clippedTo(strip.area());
  const double plane = normal_.dot(centre_);
  for (int y = part.top; y <= part.bottom; ++y)
    for (int x = part.left; x <= part.right; ++x) {
      const Vector3d ray = lens_.ray(x, y);
      const double depth = plane / normal_.dot(ray);
      if (!(depth > kNearest)) continue;
      const auto opacity = static_cast<float>(opacityAt(depth * ray - centre_));
      if (opacity <= 0.0F) continue;
      const Vector4f layer = opaque(surface_.bgr) * opacity;
      for (int sy = 0; sy < kPerAxis; ++sy) {
        const std::ptrdiff_t first = (x - strip.area().left) * kPerAxis;
        const float* nearest = strip.depths(y, sy) + first;
        Vector4f* colour = strip.colours(y, sy) + first;
        for (int sx = 0; sx < kPerAxis; ++sx)
          if (depth < nearest[sx]) colour[sx] = colour[sx] * (1.0F - opacity) + layer;
      }
    }
}

}  // namespace helical
