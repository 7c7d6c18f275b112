#pragma once

#include <compare>
#include <cstdint>

namespace helical {

/// Largest number of cameras in one rig and of markers on one helicopter. Arrays on the per-frame path have
/// these sizes, so that nothing there allocates.
inline constexpr int kMaxCameras = 16;
inline constexpr int kMaxMarkers = 16;

/// A camera's place in the rig, counted from 0 in the order of the rig file. The name that users see
/// (`CameraConfig::label`) may be any short string.
struct CameraId {
  std::uint8_t value = 0;
  constexpr int index() const { return value; }
  constexpr auto operator<=>(const CameraId&) const = default;
};

/// A marker's place in the layout, counted from 0.
struct MarkerId {
  std::uint8_t value = 0;
  constexpr int index() const { return value; }
  constexpr auto operator<=>(const MarkerId&) const = default;
};

constexpr CameraId cameraId(int index) {
  return CameraId{static_cast<std::uint8_t>(index)};
}
constexpr MarkerId markerId(int index) {
  return MarkerId{static_cast<std::uint8_t>(index)};
}

}  // namespace helical
