#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "engine/geometry/camera_model.h"

namespace helical {

/// Inclusive, in pixels.
struct PixelRect {
  int left = 0;
  int top = 0;
  int right = -1;
  int bottom = -1;

  bool isEmpty() const { return right < left || bottom < top; }
  void include(const PixelRect& other);
  PixelRect clippedTo(const PixelRect& other) const;
};

/// A strip of an image at kPerAxis^2 samples a pixel: depth and colour, premultiplied with opacity. One
/// thread.
class SampleStrip {
 public:
  static constexpr int kPerAxis = 3;

  /// The largest strip there will be, in pixels.
  SampleStrip(int width, int height);

  void start(const PixelRect& area);
  const PixelRect& area() const { return area_; }

  /// Depth and premultiplied blue, green, red, opacity of the samples in pixel row `y`, sub-row `sub`; the
  /// first is the left one of pixel `area().left`.
  float* depths(int y, int sub) { return depths_.data() + rowStart(y, sub); }
  Eigen::Vector4f* colours(int y, int sub) { return colours_.data() + rowStart(y, sub); }

  /// Offset of a sample from its pixel's centre [px].
  static double offset(int sub) { return (sub + 0.5) / kPerAxis - 0.5; }

 private:
  std::ptrdiff_t rowStart(int y, int sub) const {
    return static_cast<std::ptrdiff_t>((y - area_.top) * kPerAxis + sub) * stride_;
  }

  PixelRect area_;
  int stride_ = 0;
  std::vector<float> depths_;
  std::vector<Eigen::Vector4f> colours_;
};

/// The lens around one place of the image, to first order: a pixel's ray is (bearing, 1) in the camera frame.
struct LocalLens {
  LocalLens(const CameraModel& model, const Eigen::Vector2d& pixel);
  Eigen::Vector3d ray(double x, double y) const;

  Eigen::Vector2d pixel;
  Eigen::Vector2d bearing;
  Eigen::Vector2d per_x;
  Eigen::Vector2d per_y;
};

/// What a surface looks like; `bgr` in grey levels under full light.
enum class Finish { kPlain, kBall, kFuselage };
struct Surface {
  Eigen::Vector3f bgr = Eigen::Vector3f::Zero();
  Finish finish = Finish::kPlain;
};

/// An ellipsoid, ray-cast exactly. Everything in the camera frame.
class EllipsoidShape {
 public:
  /// Nothing if it is not wholly in front of the camera. `axes` has the unit axes as columns.
  static std::optional<EllipsoidShape> make(const CameraModel& model, const Eigen::Vector3d& centre,
                                            const Eigen::Matrix3d& axes, const Eigen::Vector3d& radii,
                                            const Surface& surface);

  const PixelRect& rect() const { return rect_; }
  void draw(SampleStrip& strip, const Eigen::Vector3d& light) const;

 private:
  EllipsoidShape(const LocalLens& lens, const Surface& surface) : lens_(lens), surface_(surface) {}
  Eigen::Vector3f shade(const Eigen::Vector3d& unit, const Eigen::Vector3d& light) const;

  LocalLens lens_;
  Surface surface_;
  PixelRect rect_;
  Eigen::Matrix3d unit_from_camera_;  ///< camera axes to the space where the ellipsoid is the unit sphere
  Eigen::Vector3d eye_;               ///< the camera's centre there
  Eigen::Vector3d to_camera_;         ///< unit
};

/// A thin rod with round ends, drawn in the image with its depth: exact enough for what is a few pixels
/// thick.
class RodShape {
 public:
  static std::optional<RodShape> make(const CameraModel& model, const Eigen::Vector3d& from,
                                      const Eigen::Vector3d& to, double radius, const Surface& surface);

  const PixelRect& rect() const { return rect_; }
  void draw(SampleStrip& strip, const Eigen::Vector3d& light) const;

 private:
  RodShape() = default;

  Eigen::Vector2d from_;
  Eigen::Vector2d along_;
  Eigen::Vector3d axis_;
  double inverse_length2_ = 0.0;
  double inverse_depth_from_ = 0.0;
  double inverse_depth_change_ = 0.0;
  double focal_radius_ = 0.0;  ///< px m: divided by depth it is the radius in the image
  Surface surface_;
  PixelRect rect_;
};

/// A turning two-bladed rotor, blurred by the exposure: a translucent disc with traces of its blades.
class RotorShape {
 public:
  /// `blade`: unit direction of a blade.
  static std::optional<RotorShape> make(const CameraModel& model, const Eigen::Vector3d& centre,
                                        const Eigen::Vector3d& normal, const Eigen::Vector3d& blade,
                                        double radius, const Surface& surface);

  const PixelRect& rect() const { return rect_; }
  void draw(SampleStrip& strip) const;

 private:
  explicit RotorShape(const LocalLens& lens) : lens_(lens) {}
  double opacityAt(const Eigen::Vector3d& from_hub) const;

  LocalLens lens_;
  Eigen::Vector3d centre_;
  Eigen::Vector3d normal_;
  Eigen::Vector3d blade_;
  double radius_ = 0.0;
  double pixel_size_ = 0.0;  ///< m at the rotor
  Surface surface_;
  PixelRect rect_;
};

}  // namespace helical
