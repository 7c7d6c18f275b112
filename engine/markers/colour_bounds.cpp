#include "engine/markers/colour_bounds.h"

#include <algorithm>
#include <bit>

#include "engine/markers/colour_class.h"

namespace helical {
namespace {

/// Extremes over the colours of a class.
struct Extremes {
  std::array<int, 3> dominance{255, 255, 255};  ///< least lead of a channel over both others
  std::array<int, 3> recession{255, 255, 255};  ///< least lead of both others over a channel
  std::array<int, 256> darkest_most{};          ///< by brightest value; -1: no such colour
  std::array<int, 256> darkest_least{};
  int value_low = 255;
  int chroma = 255;  ///< least of brightest less darkest value

  Extremes() { darkest_most.fill(-1), darkest_least.fill(256); }
  void include(const std::array<int, 3>& c);
};

void Extremes::include(const std::array<int, 3>& c) {
  const auto [low, high] = std::minmax({c[0], c[1], c[2]});
  for (std::size_t i = 0; i < 3; ++i) {
    const auto [less, more] = std::minmax(c[(i + 1) % 3], c[(i + 2) % 3]);
    dominance[i] = std::min(dominance[i], c[i] - more);
    recession[i] = std::min(recession[i], less - c[i]);
  }
  const auto v = static_cast<std::size_t>(high);
  darkest_most[v] = std::max(darkest_most[v], low);
  darkest_least[v] = std::min(darkest_least[v], low);
  value_low = std::min(value_low, high);
  chroma = std::min(chroma, high - low);
}

Extremes extremesOf(const ColourClass& colours) {
  Extremes extremes;
  const auto& table = colours.table();
  for (std::uint32_t word = 0; word < table.size(); ++word)
    for (std::uint64_t rest = table[word]; rest != 0; rest &= rest - 1) {
      const std::uint32_t colour = word * 64 + static_cast<std::uint32_t>(std::countr_zero(rest));
      extremes.include({static_cast<int>(colour & 255U), static_cast<int>(colour >> 8 & 255U),
                        static_cast<int>(colour >> 16)});
    }
  return extremes;
}

/// The lowest line that lies on or above `most` (where that is not -1).
ByteLine lineAbove(const std::array<int, 256>& most) {
  ByteLine best{8, 0};
  long best_sum = 256L * 256L;
  for (std::uint8_t eighths = 0; eighths <= 8; ++eighths) {
    const ByteLine line{eighths, 0};
    int room = 255;
    long sum = 0;
    for (int x = 0; x < 256; ++x) {
      const int limit = most[static_cast<std::size_t>(x)];
      if (limit < 0) continue;
      room = std::min(room, line.of(x) - limit);
      sum += line.of(x);
    }
    if (room < 0) continue;
    sum -= 256L * room;
    if (sum >= best_sum) continue;
    best_sum = sum;
    best = {eighths, static_cast<std::uint8_t>(room)};
  }
  return best;
}

/// The highest line that lies on or below `least` (where that is not 256).
ByteLine lineBelow(const std::array<int, 256>& least) {
  ByteLine best{0, 0};
  long best_sum = 0;
  for (std::uint8_t eighths = 1; eighths <= 8; ++eighths) {
    ByteLine line{eighths, 0};
    int excess = 0;
    for (int x = 0; x < 256; ++x)
      if (least[static_cast<std::size_t>(x)] < 256)
        excess = std::max(excess, line.of(x) - least[static_cast<std::size_t>(x)]);
    line.less = static_cast<std::uint8_t>(excess);
    long sum = 0;
    for (int x = 0; x < 256; ++x)
      if (least[static_cast<std::size_t>(x)] < 256) sum += line.of(x);
    if (sum <= best_sum) continue;
    best_sum = sum;
    best = line;
  }
  return best;
}

/// OpenCV's hue of a colour in which only this channel is not 0.
int pureHue(int channel, ColourClass::Order order) {
  if (channel == 1) return 60;
  return (channel == 2) == (order == ColourClass::Order::kBgr) ? 0 : 120;
}

/// How far the hue may turn from that of the pure channel, in eighths of the sector to the next mixture.
std::uint8_t eighthsOfTurn(int turn) {
  return static_cast<std::uint8_t>(std::clamp(turn * 8 / 30, 0, 7));
}

bool innerHolds(const ColourClass& colours, const ColourBounds& b) {
  std::array<std::uint8_t, 3> c{};
  for (int v = b.inner_value_low; v <= b.inner_value_high; ++v)
    for (int m = 0; m <= std::min(v, b.inner_darkest_at_most.of(v)); ++m)
      for (const bool a_leads : {false, true}) {
        const int reach = (a_leads ? b.inner_a_over_b : b.inner_b_over_a).of(v - m);
        for (int lead = 0; lead <= reach && m + lead <= 255; ++lead) {
          c[b.special] = static_cast<std::uint8_t>(v);
          c[static_cast<std::size_t>(otherA(b.special))] = static_cast<std::uint8_t>(a_leads ? m + lead : m);
          c[static_cast<std::size_t>(otherB(b.special))] = static_cast<std::uint8_t>(a_leads ? m : m + lead);
          if (!colours.contains(c.data())) return false;
        }
      }
  return true;
}

/// Bounds that lie a little inside of what the definition says; the table decides how little is enough.
void addInner(const ColourClass& colours, const ColourRange& o, ColourBounds& b) {
  const int hue = pureHue(b.special, colours.order());
  const int wrapped_low = (hue - o.hue_low + 180) % 180, wrapped_high = (o.hue_high - hue + 180) % 180;
  if (wrapped_low > 60 || wrapped_high > 60 || o.saturation_high < 255) return;
  // Hue grows from red to green to blue: from the pure channel to the one after it in that order.
  const bool a_is_next = (colours.order() == ColourClass::Order::kRgb);
  for (std::uint8_t less = 0; less < 6 && !b.has_inner; ++less) {
    const ByteLine up{eighthsOfTurn(wrapped_high), less}, down{eighthsOfTurn(wrapped_low), less};
    b.inner_a_over_b = a_is_next ? up : down;
    b.inner_b_over_a = a_is_next ? down : up;
    b.inner_darkest_at_most = {static_cast<std::uint8_t>((255 - o.saturation_low) * 8 / 255), less};
    b.inner_value_low = static_cast<std::uint8_t>(std::min(255, o.value_low + less));
    b.inner_value_high = static_cast<std::uint8_t>(o.value_high);
    b.has_inner = innerHolds(colours, b);
  }
}

/// Whether every colour of the box meets the inner bounds: the worst corner of each does.
bool isInside(const ColourBounds& b, const ColourBox& box) {
  const auto x = static_cast<std::size_t>(otherA(b.special)), y = static_cast<std::size_t>(otherB(b.special));
  const int least = box.low[b.special], others = std::max(box.high[x], box.high[y]);
  const int darkest = std::min(box.high[x], box.high[y]);
  return b.has_inner && others <= least && least >= b.inner_value_low &&
         box.high[b.special] <= b.inner_value_high && darkest <= b.inner_darkest_at_most.of(least) &&
         box.high[x] - box.low[y] <= b.inner_a_over_b.of(least - darkest) &&
         box.high[y] - box.low[x] <= b.inner_b_over_a.of(least - darkest);
}

ColourBox grown(const ColourBox& box, int by) {
  ColourBox larger;
  for (std::size_t i = 0; i < 3; ++i) {
    larger.low[i] = static_cast<std::uint8_t>(std::max(0, box.low[i] - by));
    larger.high[i] = static_cast<std::uint8_t>(std::min(255, box.high[i] + by));
  }
  return larger;
}

}  // namespace

std::optional<ColourBox> grownInside(const ColourBounds& bounds, const ColourBox& box) {
  if (!isInside(bounds, box)) return std::nullopt;
  int by = 0;
  for (int step = 128; step > 0; step /= 2)
    if (isInside(bounds, grown(box, by + step))) by += step;
  return grown(box, by);
}

ColourBounds deriveBounds(const ColourClass& colours, const ColourRange& options) {
  const Extremes extremes = extremesOf(colours);
  const auto dominant = std::max_element(extremes.dominance.begin(), extremes.dominance.end());
  const auto recessive = std::max_element(extremes.recession.begin(), extremes.recession.end());
  ColourBounds bounds;
  bounds.value_low = static_cast<std::uint8_t>(extremes.value_low);
  bounds.chroma = static_cast<std::uint8_t>(extremes.chroma);
  bounds.darkest_at_most = lineAbove(extremes.darkest_most);
  bounds.darkest_at_least = lineBelow(extremes.darkest_least);
  if (*dominant >= 0) {
    bounds.shape = ColourBounds::Shape::kDominant;
    bounds.special = static_cast<std::uint8_t>(dominant - extremes.dominance.begin());
    bounds.lead = static_cast<std::uint8_t>(*dominant);
    addInner(colours, options, bounds);
  } else if (*recessive >= 0) {
    bounds.shape = ColourBounds::Shape::kRecessive;
    bounds.special = static_cast<std::uint8_t>(recessive - extremes.recession.begin());
    bounds.lead = static_cast<std::uint8_t>(*recessive);
  }
  return bounds;
}

}  // namespace helical
