#include "engine/cameras/webcam/webcam_settings.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "engine/base/error.h"

namespace helical {
namespace {

using Property = VideoCapture::Property;

constexpr const char* kUsualFormat = "MJPG";  // others fill the USB at a few frames a second
constexpr double kManualExposure = 1.0;       // as V4L2 numbers it
constexpr double kExposureUnitUs = 100.0;     // V4L2's
constexpr double kRateTolerance = 0.01;

[[noreturn]] void notOffered(const std::string& what, const std::string& cure, const std::string& where) {
  throw Error(ErrorKind::kInput, "the webcam does not offer " + what, where, cure);
}

/// What webcams of any kind do not know.
void refuseForeignSettings(const DeviceOptions& options, const std::string& where) {
  const auto refuse = [&](bool given, const char* key) {
    if (given) notOffered(key, std::string("leave ") + key + " out", where);
  };
  refuse(options.offset_x != 0 || options.offset_y != 0, "offset");
  refuse(options.gain_db.has_value(), "gain_db");
  refuse(options.balance_red.has_value(), "balance_red");
  refuse(options.balance_blue.has_value(), "balance_blue");
  refuse(options.trigger != TriggerMode::kFree, "trigger");
  refuse(options.ptp, "ptp");
}

std::string sizeName(int width, int height) {
  return std::to_string(width) + "x" + std::to_string(height);
}

void setFormat(VideoCapture& capture, const DeviceOptions& options, int width, int height, const std::string& where) {
  const std::string wanted = options.format.empty() ? kUsualFormat : options.format;
  capture.set(Property::kFourCc, toFourCc(wanted));  // first: sizes and rates depend on it
  capture.set(Property::kWidth, width);
  capture.set(Property::kHeight, height);
  const std::string given = nameOfFourCc(capture.get(Property::kFourCc));
  if (!options.format.empty() && given != options.format)
    notOffered("the format '" + options.format + "' at " + sizeName(width, height),
               "it gives " + given + "; `helical devices` lists all", where);
  const auto given_width = static_cast<int>(capture.get(Property::kWidth));
  const auto given_height = static_cast<int>(capture.get(Property::kHeight));
  if (given_width != width || given_height != height)
    notOffered(sizeName(width, height) + " pixels",
               "it gives " + sizeName(given_width, given_height) + "; `helical devices` lists its sizes", where);
}

void setRate(VideoCapture& capture, double rate_hz, const std::string& where) {
  capture.set(Property::kRate, rate_hz);
  const double given = capture.get(Property::kRate);
  if (given <= 0.0 || std::abs(given - rate_hz) <= kRateTolerance * rate_hz) return;
  std::ostringstream what, cure;
  what << "rate_hz = " << rate_hz;
  cure << "it gives " << given << "; `helical devices` lists its rates";
  notOffered(what.str(), cure.str(), where);
}

void setExposure(VideoCapture& capture, double exposure_us, const std::string& where) {
  if (capture.set(Property::kAutoExposure, kManualExposure) &&
      capture.set(Property::kExposure, std::round(exposure_us / kExposureUnitUs)))
    return;
  notOffered("exposure_us", "leave exposure_us out, or give another time in steps of 100", where);
}

}  // namespace

void applyWebcamSettings(VideoCapture& capture, const DeviceOptions& options, int width, int height,
                         const std::string& where) {
  refuseForeignSettings(options, where);
  setFormat(capture, options, width, height, where);
  setRate(capture, options.rate_hz, where);
  if (options.exposure_us) setExposure(capture, *options.exposure_us, where);
}

LightSetting lightOf(const VideoCapture& capture, const DeviceOptions& options) {
  LightSetting light;
  light.gain_in_db = false;
  if (options.exposure_us) light.exposure_us = kExposureUnitUs * std::max(0.0, capture.get(Property::kExposure));
  if (const double gain = capture.get(Property::kGain); gain > 0.0) light.gain = gain;
  return light;
}

}  // namespace helical
