#include "engine/markers/colour_class.h"

#include <mutex>
#include <opencv2/imgproc.hpp>
#include <tuple>
#include <utility>

#include "engine/markers/colour_range.h"

namespace helical {
namespace {

auto key(const ColourRange& o, ColourClass::Order order) {
  return std::tuple(o.hue_low, o.hue_high, o.saturation_low, o.saturation_high, o.value_low, o.value_high,
                    order);
}

/// Every colour with this last byte: the first byte along x, the second along y.
cv::Mat planeOf(int last, ColourClass::Order order) {
  cv::Mat plane(256, 256, CV_8UC3);
  for (int second = 0; second < 256; ++second) {
    auto* pixel = plane.ptr<cv::Vec3b>(second);
    for (int first = 0; first < 256; ++first) {
      const auto [blue, red] =
          order == ColourClass::Order::kBgr ? std::pair(first, last) : std::pair(last, first);
      pixel[first] = {static_cast<std::uint8_t>(blue), static_cast<std::uint8_t>(second),
                      static_cast<std::uint8_t>(red)};
    }
  }
  return plane;
}

}  // namespace

std::shared_ptr<const ColourClass> ColourClass::of(const ColourRange& options, Order order) {
  static std::mutex mutex;
  static std::vector<std::pair<decltype(key(options, order)), std::weak_ptr<const ColourClass>>> known;
  const auto find = [&]() -> std::shared_ptr<const ColourClass> {
    for (const auto& [range, weak] : known)
      if (range == key(options, order))
        if (auto alive = weak.lock()) return alive;
    return nullptr;
  };
  {
    const std::lock_guard lock(mutex);
    if (auto alive = find()) return alive;
  }
  // Not under the lock: building takes long, and a capture thread may be waiting for a class that exists.
  auto made = std::make_shared<const ColourClass>(options, order);
  const std::lock_guard lock(mutex);
  if (auto alive = find()) return alive;
  std::erase_if(known, [](const auto& entry) { return entry.second.expired(); });
  known.emplace_back(key(options, order), made);
  return made;
}

ColourClass::ColourClass(const ColourRange& options, Order order) : order_(order), table_((1U << 24) / 64) {
  cv::Mat mask;
  for (int last = 0; last < 256; ++last) {
    markerColourMask(planeOf(last, order), options, mask);
    const std::uint8_t* set = mask.ptr();
    std::uint64_t* words = table_.data() + static_cast<std::size_t>(last) * 1024;
    for (std::size_t i = 0; i < 65536; ++i)
      words[i >> 6] |= static_cast<std::uint64_t>(set[i] & 1U) << (i & 63U);
  }
  has_slices_ = slices_.derive(table_);
  bounds_ = deriveBounds(*this, options);
}

}  // namespace helical
