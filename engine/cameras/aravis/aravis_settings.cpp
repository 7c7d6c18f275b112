#include "engine/cameras/aravis/aravis_settings.h"

#include <arv.h>

#include <algorithm>
#include <sstream>
#include <utility>
#include <vector>

#include "engine/base/error.h"
#include "engine/cameras/aravis/aravis_error.h"
#include "engine/cameras/aravis/gvcp_action.h"

namespace helical {
namespace {

struct NamedFormat {
  ArvPixelFormat genicam;
  PixelFormat ours;
};
/// In the order of preference.
constexpr NamedFormat kFormats[] = {
    {ARV_PIXEL_FORMAT_BAYER_RG_8, PixelFormat::kBayerRg8}, {ARV_PIXEL_FORMAT_BAYER_GR_8, PixelFormat::kBayerGr8},
    {ARV_PIXEL_FORMAT_BAYER_GB_8, PixelFormat::kBayerGb8}, {ARV_PIXEL_FORMAT_BAYER_BG_8, PixelFormat::kBayerBg8},
    {ARV_PIXEL_FORMAT_BGR_8_PACKED, PixelFormat::kBgr8},   {ARV_PIXEL_FORMAT_RGB_8_PACKED, PixelFormat::kRgb8},
    {ARV_PIXEL_FORMAT_MONO_8, PixelFormat::kMono8},
};

constexpr int kActionNumber = 1;

/// One camera while it is set up.
class Setup {
 public:
  Setup(ArvCamera* camera, const std::string& where)
      : camera_(camera), device_(arv_camera_get_device(camera)), where_(where) {}

  bool has(const char* feature) { return arv_device_is_feature_available(device_, feature, nullptr) != 0; }
  void integer(const char* feature, gint64 value) {
    arv_device_set_integer_feature_value(device_, feature, value, error_.slot());
    error_.check(std::string("setting ") + feature, where_);
  }
  void flag(const char* feature, bool value) {
    arv_device_set_boolean_feature_value(device_, feature, value ? TRUE : FALSE, error_.slot());
    error_.check(std::string("setting ") + feature, where_);
  }
  void text(const char* feature, const char* value) {
    arv_device_set_string_feature_value(device_, feature, value, error_.slot());
    error_.check(std::string("setting ") + feature, where_);
  }
  void textIfThere(const char* feature, const char* value) {
    if (has(feature)) text(feature, value);
  }

  /// A number within what the camera offers.
  void real(const char* feature, double value, const char* key) {
    if (!has(feature)) notOffered(key, "leave " + std::string(key) + " out");
    double low = 0.0, high = 0.0;
    arv_device_get_float_feature_bounds(device_, feature, &low, &high, error_.slot());
    error_.check(std::string("asking for the bounds of ") + feature, where_);
    constexpr double kRounding = 1e-6;
    if (value < low * (1.0 - kRounding) || value > high * (1.0 + kRounding)) {
      std::ostringstream what, cure;
      what << key << " = " << value << " is beyond the camera";
      cure << "it offers " << low << " to " << high;
      throw Error(ErrorKind::kInput, what.str(), where_, cure.str());
    }
    arv_device_set_float_feature_value(device_, feature, value, error_.slot());
    error_.check(std::string("setting ") + feature, where_);
  }

  void region(const DeviceOptions& options, int width, int height) {
    const bool movable = has("OffsetX") && has("OffsetY");
    if (movable) integer("OffsetX", 0), integer("OffsetY", 0);
    side("Width", options.offset_x + width, width);
    side("Height", options.offset_y + height, height);
    if (movable) integer("OffsetX", options.offset_x), integer("OffsetY", options.offset_y);
  }

  void format(const std::string& name) {
    guint count = 0;
    const char** names = arv_camera_dup_available_pixel_formats_as_strings(camera_, &count, error_.slot());
    error_.check("asking for its pixel formats", where_);
    const std::vector<std::string> offered(names, names + count);
    g_free(static_cast<void*>(names));
    guint known = 0;
    gint64* numbers = arv_camera_dup_available_pixel_formats(camera_, &known, error_.slot());
    error_.check("asking for its pixel formats", where_);
    const std::vector<gint64> codes(numbers, numbers + known);
    g_free(numbers);
    text("PixelFormat", chosen(name, offered, codes).c_str());
  }

  void clearTriggers() { arv_camera_clear_triggers(camera_, error_.slot()); }

  [[noreturn]] void notOffered(const std::string& what, const std::string& cure) const {
    throw Error(ErrorKind::kInput, "the camera does not offer " + what, where_, cure);
  }

 private:
  void side(const char* feature, int needed, int value) {
    gint64 low = 0, high = 0;
    // Bounds of the width shrink with the offset, which is 0 here.
    arv_device_get_integer_feature_bounds(device_, feature, &low, &high, error_.slot());
    error_.check(std::string("asking for the bounds of ") + feature, where_);
    if (value < low || needed > high)
      throw Error(ErrorKind::kInput,
                  std::string("a region that ends at ") + std::to_string(needed) +
                      " px is beyond the camera's " + feature,
                  where_, "it offers " + std::to_string(low) + " to " + std::to_string(high));
    integer(feature, value);
  }

  std::string chosen(const std::string& name, const std::vector<std::string>& offered,
                     const std::vector<gint64>& codes) const {
    std::string usable;
    for (const NamedFormat& format : kFormats) {
      const auto at = std::find(codes.begin(), codes.end(), static_cast<gint64>(format.genicam));
      if (at == codes.end()) continue;
      const std::string& offer = offered[static_cast<std::size_t>(at - codes.begin())];
      if (name.empty() || name == offer) return offer;
      usable += (usable.empty() ? "" : ", ") + offer;
    }
    const std::string what = name.empty() ? "a pixel format that can be used" : "the pixel format '" + name + "'";
    notOffered(what, usable.empty() ? "use a camera with 8 bit Bayer, colour or grey"
                                    : "give format as one of " + usable);
  }

  ArvCamera* camera_;
  ArvDevice* device_;
  std::string where_;
  AravisError error_;
};

void setLight(Setup& setup, const DeviceOptions& options) {
  if (options.exposure_us) {
    setup.textIfThere("ExposureAuto", "Off");
    const char* feature = setup.has("ExposureTime") ? "ExposureTime" : "ExposureTimeAbs";
    setup.real(feature, *options.exposure_us, "exposure_us");
  }
  if (options.gain_db) {
    setup.textIfThere("GainAuto", "Off");
    setup.real("Gain", *options.gain_db, "gain_db");
  }
  if (options.balance_red || options.balance_blue) setup.textIfThere("BalanceWhiteAuto", "Off");
  const auto balance = [&](const std::optional<double>& ratio, const char* colour, const char* key) {
    if (!ratio) return;
    if (!setup.has("BalanceRatioSelector")) setup.notOffered(key, "leave " + std::string(key) + " out");
    setup.text("BalanceRatioSelector", colour);
    setup.real("BalanceRatio", *ratio, key);
  };
  balance(options.balance_red, "Red", "balance_red");
  balance(options.balance_blue, "Blue", "balance_blue");
}

void setActionKeys(Setup& setup) {
  if (setup.has("ActionSelector")) setup.integer("ActionSelector", kActionNumber);
  for (const auto& [feature, value] : {std::pair("ActionDeviceKey", kActionDeviceKey),
                                       std::pair("ActionGroupKey", kActionGroupKey),
                                       std::pair("ActionGroupMask", kActionGroupMask)}) {
    if (!setup.has(feature)) setup.notOffered("actions", "use trigger = \"software\" or \"line\"");
    setup.integer(feature, value);
  }
}

void setTrigger(Setup& setup, const DeviceOptions& options) {
  setup.clearTriggers();
  if (options.trigger == TriggerMode::kFree) {
    if (setup.has("AcquisitionFrameRateEnable")) setup.flag("AcquisitionFrameRateEnable", true);
    const char* feature = setup.has("AcquisitionFrameRate") ? "AcquisitionFrameRate" : "AcquisitionFrameRateAbs";
    setup.real(feature, options.rate_hz, "rate_hz");
    return;
  }
  if (!setup.has("TriggerMode")) setup.notOffered("a trigger", "leave trigger out: it runs freely");
  setup.textIfThere("TriggerSelector", "FrameStart");
  setup.text("TriggerMode", "On");
  setup.text("TriggerSource", options.trigger == TriggerMode::kSoftware ? "Software"
                              : options.trigger == TriggerMode::kAction ? "Action1"
                                                                        : options.trigger_line.c_str());
  if (options.trigger == TriggerMode::kAction) setActionKeys(setup);
  if (options.trigger == TriggerMode::kLine) setup.textIfThere("TriggerActivation", "RisingEdge");
}

/// The exposure's own stamp with each image, where the camera has one; its packets' may be those of their way out.
void setChunks(Setup& setup) {
  if (!setup.has("ChunkModeActive") || !setup.has("ChunkTimestamp")) return;
  setup.flag("ChunkModeActive", true);
  setup.textIfThere("ChunkSelector", "Timestamp");
  setup.flag("ChunkEnable", true);
}

void setPtp(Setup& setup, bool on) {
  const char* const feature = setup.has("PtpEnable") ? "PtpEnable" : "GevIEEE1588";
  if (setup.has(feature)) return setup.flag(feature, on);
  if (on) setup.notOffered("PTP", "leave ptp out: its clock is measured instead");
}

}  // namespace

void applySettings(_ArvCamera* camera, const DeviceOptions& options, int width, int height, const std::string& where) {
  Setup setup(camera, where);
  setup.region(options, width, height);
  setup.format(options.format);
  setLight(setup, options);  // before the rate: a long exposure bounds it
  setTrigger(setup, options);
  setPtp(setup, options.ptp);
  setChunks(setup);
  setup.textIfThere("AcquisitionMode", "Continuous");
  if (arv_camera_is_gv_device(camera) == 0) return;
  AravisError error;
  arv_camera_gv_set_packet_size_adjustment(camera, ARV_GV_PACKET_SIZE_ADJUSTMENT_NEVER);
  arv_camera_gv_set_packet_size(camera, options.packet_bytes, error.slot());
  error.check("setting the packet size", where);
  arv_camera_gv_set_packet_delay(camera, static_cast<gint64>(1e3 * options.packet_delay_us), error.slot());
  error.check("setting the packet delay", where);
  arv_camera_gv_set_stream_options(camera, options.packet_socket ? ARV_GV_STREAM_OPTION_NONE
                                                                 : ARV_GV_STREAM_OPTION_PACKET_SOCKET_DISABLED);
}

LightSetting lightOf(_ArvCamera* camera) {
  LightSetting light;
  AravisError error;  // what it does not tell stays unknown
  if (arv_camera_is_exposure_time_available(camera, nullptr) != 0)
    light.exposure_us = arv_camera_get_exposure_time(camera, nullptr);
  if (arv_camera_is_gain_available(camera, nullptr) == 0) return light;
  const double gain = arv_camera_get_gain(camera, error.slot());
  if (error) return light;
  light.gain = gain;
  light.gain_in_db = arv_device_is_feature_available(arv_camera_get_device(camera), "Gain", nullptr) != 0;
  return light;
}

bool toPixelFormat(unsigned genicam_format, PixelFormat& format) {
  for (const NamedFormat& known : kFormats)
    if (known.genicam == genicam_format) {
      format = known.ours;
      return true;
    }
  return false;
}

}  // namespace helical
