#include "engine/correspondence/tried_labellings.h"

#include <algorithm>
#include <charconv>
#include <numeric>

namespace helical {

void TriedLabellings::add(const TriedLabelling& labelling) {
  if (count == 0) {
    all[static_cast<std::size_t>(count++)] = labelling;
    return;
  }
  int place = count;
  while (place > 1 && all[static_cast<std::size_t>(place - 1)].value > labelling.value) --place;
  if (place == kMost) return;
  count = std::min(count + 1, kMost);
  for (int i = count - 1; i > place; --i) all[static_cast<std::size_t>(i)] = all[static_cast<std::size_t>(i - 1)];
  all[static_cast<std::size_t>(place)] = labelling;
}

TriedLabelling fromLeftToRight(std::span<const std::uint8_t> markers, std::span<const Eigen::Vector2d> pixels,
                               double value) {
  std::array<std::size_t, kMaxMarkers> order{};
  const std::size_t count = std::min({markers.size(), pixels.size(), order.size()});
  const auto end = order.begin() + static_cast<std::ptrdiff_t>(count);
  std::iota(order.begin(), end, std::size_t{0});
  std::sort(order.begin(), end, [&](std::size_t a, std::size_t b) { return pixels[a].x() < pixels[b].x(); });
  TriedLabelling result;
  result.count = static_cast<int>(count);
  result.value = static_cast<float>(value);
  for (std::size_t i = 0; i < count; ++i) result.marker[i] = markers[order[i]];
  return result;
}

std::string_view writeNames(const TriedLabellings& labellings, LabellingNames& buffer) {
  char* at = buffer.data();
  char* const end = buffer.data() + buffer.size();
  for (int i = 0; i < labellings.count; ++i) {
    const TriedLabelling& labelling = labellings.all[static_cast<std::size_t>(i)];
    if (i > 0) *at++ = ' ';
    for (int m = 0; m < labelling.count; ++m) {
      if (m > 0) *at++ = '-';
      at = std::to_chars(at, end, static_cast<int>(labelling.marker[static_cast<std::size_t>(m)])).ptr;
    }
  }
  return {buffer.data(), static_cast<std::size_t>(at - buffer.data())};
}

TriedLabellings readNames(std::string_view text) {
  TriedLabellings labellings;
  while (!text.empty() && labellings.count < TriedLabellings::kMost) {
    const std::string_view name = text.substr(0, text.find(' '));
    text.remove_prefix(std::min(text.size(), name.size() + 1));
    TriedLabelling& labelling = labellings.all[static_cast<std::size_t>(labellings.count++)];
    for (std::string_view rest = name; !rest.empty() && labelling.count < kMaxMarkers;) {
      std::uint8_t marker = 0;
      const auto [stopped, failure] = std::from_chars(rest.data(), rest.data() + rest.size(), marker);
      if (failure != std::errc() || marker >= kMaxMarkers) break;
      labelling.marker[static_cast<std::size_t>(labelling.count++)] = marker;
      rest.remove_prefix(std::min(rest.size(), static_cast<std::size_t>(stopped - rest.data()) + 1));
    }
  }
  return labellings;
}

}  // namespace helical
