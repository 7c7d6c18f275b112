#include "engine/cameras/webcam/webcam_discovery.h"

#include <fcntl.h>
#include <linux/videodev2.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>

namespace helical {
namespace {

namespace fs = std::filesystem;
using Ioctl = std::function<int(unsigned long request, void* answer)>;

std::string nameOf(std::uint32_t four_characters) {
  std::string name;
  for (int i = 0; i < 4; ++i) name += static_cast<char>(four_characters >> (8 * i) & 0x7f);
  return name;
}

void addRate(const v4l2_fract& interval, FoundCamera& found) {
  if (interval.numerator == 0) return;
  const double rate = static_cast<double>(interval.denominator) / interval.numerator;
  found.highest_rate_hz = std::max(found.highest_rate_hz, rate);
  found.lowest_rate_hz = found.lowest_rate_hz > 0.0 ? std::min(found.lowest_rate_hz, rate) : rate;
}

void askRates(const Ioctl& ask, std::uint32_t format, std::uint32_t width, std::uint32_t height, FoundCamera& found) {
  v4l2_frmivalenum interval{};
  interval.pixel_format = format;
  interval.width = width;
  interval.height = height;
  for (; ask(VIDIOC_ENUM_FRAMEINTERVALS, &interval) == 0; ++interval.index) {
    if (interval.type == V4L2_FRMIVAL_TYPE_DISCRETE) {
      addRate(interval.discrete, found);
      continue;
    }
    addRate(interval.stepwise.min, found);
    addRate(interval.stepwise.max, found);
    return;
  }
}

void askSizes(const Ioctl& ask, std::uint32_t format, FoundCamera& found) {
  v4l2_frmsizeenum size{};
  size.pixel_format = format;
  for (; ask(VIDIOC_ENUM_FRAMESIZES, &size) == 0; ++size.index) {
    const bool discrete = size.type == V4L2_FRMSIZE_TYPE_DISCRETE;
    const std::uint32_t width = discrete ? size.discrete.width : size.stepwise.max_width;
    const std::uint32_t height = discrete ? size.discrete.height : size.stepwise.max_height;
    const auto w = static_cast<int>(width), h = static_cast<int>(height);
    if (w * h > found.width * found.height) found.width = w, found.height = h;
    askRates(ask, format, width, height, found);
    if (!discrete) return;
  }
}

/// False for a node that gives no pictures: cameras have one for their metadata, too.
bool inspect(const fs::path& path, FoundCamera& found) {
  found.source = "webcam:" + path.string();
  found.kind = "webcam";
  found.owner = "free";
  const int device = open(path.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC);
  if (device < 0) {
    found.owner = std::string("cannot be opened: ") + std::strerror(errno);
    return true;
  }
  const bool captures =
      describeWebcam([device](unsigned long request, void* answer) { return ioctl(device, request, answer); }, found);
  close(device);
  return captures;
}

}  // namespace

bool describeWebcam(const Ioctl& ask, FoundCamera& found) {
  v4l2_capability capability{};
  if (ask(VIDIOC_QUERYCAP, &capability) != 0 || (capability.device_caps & V4L2_CAP_VIDEO_CAPTURE) == 0) return false;
  found.name = reinterpret_cast<const char*>(capability.card);
  found.serial = reinterpret_cast<const char*>(capability.bus_info);
  v4l2_fmtdesc format{};
  format.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  for (; ask(VIDIOC_ENUM_FMT, &format) == 0; ++format.index) {
    found.formats.push_back(nameOf(format.pixelformat));
    askSizes(ask, format.pixelformat, found);
  }
  return true;
}

std::vector<FoundCamera> findWebcams() {
  std::vector<fs::path> nodes;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator("/dev", ignored))
    if (entry.path().filename().string().starts_with("video")) nodes.push_back(entry.path());
  std::sort(nodes.begin(), nodes.end());
  std::vector<FoundCamera> cameras;
  for (const fs::path& node : nodes) {
    FoundCamera found;
    if (inspect(node, found)) cameras.push_back(found);
  }
  return cameras;
}

}  // namespace helical
