#include "engine/markers/colour_class.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <mutex>
#include <opencv2/imgproc.hpp>
#include <tuple>
#include <utility>

#include "engine/markers/colour_range.h"

namespace helical {
namespace {

using Bytes [[gnu::vector_size(16)]] = std::uint8_t;

Bytes load(const std::uint8_t* p) {
  Bytes v;
  std::memcpy(&v, p, sizeof v);
  return v;
}

Bytes larger(Bytes a, Bytes b) {
  return a > b ? a : b;
}
Bytes smaller(Bytes a, Bytes b) {
  return a < b ? a : b;
}
Bytes saturatedDifference(Bytes a, Bytes b) {
  return larger(a, b) - b;
}
Bytes broadcast(std::uint8_t value) {
  return Bytes{} + value;
}

constexpr int kBlockBytes = 64 * 3;
constexpr int kStep = 16;
/// The last step starts here: it overlaps the one before so that no byte behind the 64 pixels is read.
constexpr int kLastStep = kBlockBytes - 2 - kStep;

/// 255 at the bytes where no pixel starts.
constexpr auto kNotFirstByte = [] {
  std::array<std::uint8_t, kBlockBytes> mask{};
  for (std::size_t i = 0; i < mask.size(); ++i) mask[i] = i % 3 == 0 ? 0 : 255;
  return mask;
}();

template <class Rejects>
bool anyPixel(Rejects rejects) {
  Bytes least = broadcast(255);
  for (int k = 0; k < kLastStep; k += kStep)
    least = smaller(least, rejects(k) | load(kNotFirstByte.data() + k));
  least = smaller(least, rejects(kLastStep) | load(kNotFirstByte.data() + kLastStep));
  std::array<std::uint8_t, kStep> values{};
  std::memcpy(values.data(), &least, sizeof least);
  return std::find(values.begin(), values.end(), 0) != values.end();
}

auto key(const MarkerOptions& o) {
  return std::tuple(o.hue_low, o.hue_high, o.saturation_low, o.saturation_high, o.value_low, o.value_high);
}

}  // namespace

std::shared_ptr<const ColourClass> ColourClass::of(const MarkerOptions& options) {
  static std::mutex mutex;
  static std::vector<std::pair<decltype(key(options)), std::weak_ptr<const ColourClass>>> known;
  const std::lock_guard lock(mutex);
  std::erase_if(known, [](const auto& entry) { return entry.second.expired(); });
  for (const auto& [range, weak] : known)
    if (range == key(options)) return weak.lock();
  auto made = std::make_shared<const ColourClass>(options);
  known.emplace_back(key(options), made);
  return made;
}

ColourClass::ColourClass(const MarkerOptions& options) : table_((1U << 24) / 64) {
  // One 256x256 image per value of red: blue along x, green along y.
  cv::Mat plane(256, 256, CV_8UC3);
  cv::Mat mask;
  for (int red = 0; red < 256; ++red) {
    for (int green = 0; green < 256; ++green) {
      auto* pixel = plane.ptr<cv::Vec3b>(green);
      for (int blue = 0; blue < 256; ++blue)
        pixel[blue] = {static_cast<std::uint8_t>(blue), static_cast<std::uint8_t>(green),
                       static_cast<std::uint8_t>(red)};
    }
    markerColourMask(plane, options, mask);
    const std::uint8_t* set = mask.ptr();
    std::uint64_t* words = table_.data() + static_cast<std::size_t>(red) * 1024;
    for (std::size_t i = 0; i < 65536; ++i)
      words[i >> 6] |= static_cast<std::uint64_t>(set[i] & 1U) << (i & 63U);
  }
  deriveBounds();
}

void ColourClass::deriveBounds() {
  std::array<int, 3> least_lead{255, 255, 255};
  int least_chroma = 255;
  for (std::uint32_t word = 0; word < table_.size(); ++word) {
    if (table_[word] == 0) continue;
    for (std::uint32_t bit = 0; bit < 64; ++bit) {
      if ((table_[word] >> bit & 1U) == 0) continue;
      const std::uint32_t colour = word * 64 + bit;
      const std::array<int, 3> c{static_cast<int>(colour & 255U), static_cast<int>(colour >> 8 & 255U),
                                 static_cast<int>(colour >> 16)};
      for (std::size_t i = 0; i < 3; ++i)
        least_lead[i] = std::min(least_lead[i], c[i] - std::max(c[(i + 1) % 3], c[(i + 2) % 3]));
      const auto [low, high] = std::minmax({c[0], c[1], c[2]});
      least_chroma = std::min(least_chroma, high - low);
    }
  }
  const auto best = std::max_element(least_lead.begin(), least_lead.end());
  dominant_ = static_cast<int>(best - least_lead.begin());
  other_a_ = (dominant_ + 1) % 3;
  other_b_ = (dominant_ + 2) % 3;
  has_dominant_ = *best >= 0;
  lead_ = static_cast<std::uint8_t>(std::max(0, *best));
  chroma_ = static_cast<std::uint8_t>(least_chroma);
}

bool ColourClass::mayContain64(const std::uint8_t* bgr) const {
  const Bytes lead = broadcast(lead_);
  const Bytes chroma = broadcast(chroma_);
  if (has_dominant_)
    return anyPixel([&](int k) {
      const Bytes d = load(bgr + k + dominant_), a = load(bgr + k + other_a_), b = load(bgr + k + other_b_);
      return saturatedDifference(larger(a, b), saturatedDifference(d, lead)) |
             saturatedDifference(smaller(a, b), saturatedDifference(d, chroma));
    });
  return anyPixel([&](int k) {
    const Bytes a = load(bgr + k), b = load(bgr + k + 1), c = load(bgr + k + 2);
    const Bytes spread = larger(larger(a, b), c) - smaller(smaller(a, b), c);
    return saturatedDifference(chroma, spread);
  });
}

}  // namespace helical
