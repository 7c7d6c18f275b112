#include "engine/session/message_units.h"

#include <string_view>

namespace helical {
namespace {

struct Rule {
  std::string_view part;
  std::string_view unit;
};

constexpr Rule kSuffixes[] = {{"_px2", "px^2"}, {"_m_s", "m/s"}, {"_px", "px"},
                              {"_ns", "ns"},    {"_hz", "Hz"},   {"_s", "s"},
                              {"_m", "m"},      {"_rad", "rad"}, {"stamp", "s"}};

constexpr Rule kInside[] = {
    {"position.", "m"}, {"translation.", "m"}, {"linear.", "m/s"}, {"angular.", "rad/s"}};

constexpr std::string_view kCameraInfoPixels[] = {"width",        "height",       "k",         "p",
                                                  "roi.x_offset", "roi.y_offset", "roi.width", "roi.height"};

/// Of a pose: place first, then rotation.
std::string covarianceUnit(int index) {
  const bool turns_row = index / 6 >= 3, turns_column = index % 6 >= 3;
  if (turns_row && turns_column) return "rad^2";
  return turns_row || turns_column ? "m rad" : "m^2";
}

}  // namespace

std::string unitOf(const std::string& message, const std::string& path, int index) {
  if (path.ends_with("covariance")) return covarianceUnit(index);
  if (message.starts_with("sensor_msgs") && message.ends_with("CameraInfo"))
    for (const auto& pixels : kCameraInfoPixels)
      if (path == pixels) return "px";
  for (const Rule& rule : kSuffixes)
    if (path.ends_with(rule.part)) return std::string(rule.unit);
  for (const Rule& rule : kInside)
    if (path.find(rule.part) != std::string::npos) return std::string(rule.unit);
  return {};
}

}  // namespace helical
