// What a webcam's driver answers, with a driver of the test's own.

#include "engine/cameras/webcam/webcam_discovery.h"

#include <gtest/gtest.h>
#include <linux/videodev2.h>

#include <cstring>
#include <vector>

namespace helical {
namespace {

struct Mode {
  std::uint32_t format, width, height;
  std::vector<std::uint32_t> rates;
};

/// Two formats: raw up to 640 x 480, packed up to 1280 x 720, which raw does not offer.
const std::vector<Mode> kModes{{V4L2_PIX_FMT_YUYV, 320, 240, {30}},
                               {V4L2_PIX_FMT_YUYV, 640, 480, {30, 15}},
                               {V4L2_PIX_FMT_MJPEG, 640, 480, {60, 30}},
                               {V4L2_PIX_FMT_MJPEG, 1280, 720, {30, 5}}};

int answer(unsigned long request, void* to) {
  if (request == VIDIOC_QUERYCAP) {
    auto& capability = *static_cast<v4l2_capability*>(to);
    std::strcpy(reinterpret_cast<char*>(capability.card), "HD Webcam");
    std::strcpy(reinterpret_cast<char*>(capability.bus_info), "usb-0000:00:14.0-3");
    capability.device_caps = V4L2_CAP_VIDEO_CAPTURE;
    return 0;
  }
  if (request == VIDIOC_ENUM_FMT) {
    auto& format = *static_cast<v4l2_fmtdesc*>(to);
    if (format.index > 1) return -1;
    format.pixelformat = format.index == 0 ? V4L2_PIX_FMT_YUYV : V4L2_PIX_FMT_MJPEG;
    return 0;
  }
  if (request == VIDIOC_ENUM_FRAMESIZES) {
    auto& size = *static_cast<v4l2_frmsizeenum*>(to);
    std::uint32_t index = 0;
    for (const Mode& mode : kModes) {
      if (mode.format != size.pixel_format || index++ != size.index) continue;
      size.type = V4L2_FRMSIZE_TYPE_DISCRETE;
      size.discrete = {mode.width, mode.height};
      return 0;
    }
    return -1;
  }
  auto& interval = *static_cast<v4l2_frmivalenum*>(to);
  for (const Mode& mode : kModes) {
    if (mode.format != interval.pixel_format || mode.width != interval.width || mode.height != interval.height) continue;
    if (interval.index >= mode.rates.size()) return -1;
    interval.type = V4L2_FRMIVAL_TYPE_DISCRETE;
    interval.discrete = {1, mode.rates[interval.index]};
    return 0;
  }
  return -1;
}

TEST(WebcamDiscovery, TellsNameFormatsLargestSizeAndRates) {
  FoundCamera found;
  ASSERT_TRUE(describeWebcam(answer, found));
  EXPECT_EQ(found.name, "HD Webcam");
  EXPECT_EQ(found.serial, "usb-0000:00:14.0-3");
  EXPECT_EQ(found.formats, (std::vector<std::string>{"YUYV", "MJPG"}));
  EXPECT_EQ(found.width, 1280);
  EXPECT_EQ(found.height, 720);
  EXPECT_EQ(found.lowest_rate_hz, 5.0);
  EXPECT_EQ(found.highest_rate_hz, 60.0);
}

TEST(WebcamDiscovery, LeavesOutNodesThatGiveNoPictures) {
  FoundCamera found;
  EXPECT_FALSE(describeWebcam([](unsigned long, void*) { return -1; }, found));
  EXPECT_FALSE(describeWebcam(
      [](unsigned long request, void* to) {
        if (request == VIDIOC_QUERYCAP) static_cast<v4l2_capability*>(to)->device_caps = V4L2_CAP_META_CAPTURE;
        return 0;
      },
      found));
}

}  // namespace
}  // namespace helical
