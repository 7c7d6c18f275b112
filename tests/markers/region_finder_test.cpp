#include "engine/markers/region_finder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "engine/base/random.h"
#include "engine/markers/reference_extractor.h"
#include "tests/markers/scenes.h"

namespace helical {
namespace {

using test::Picture;

enum class Scene { kNoise, kBlocks, kBalls, kClutter, kAllMarker, kHalfMarker, kHoles };
constexpr std::array kScenes{Scene::kNoise,     Scene::kBlocks,     Scene::kBalls, Scene::kClutter,
                             Scene::kAllMarker, Scene::kHalfMarker, Scene::kHoles};

constexpr std::array kFormats{PixelFormat::kBgr8,     PixelFormat::kRgb8,     PixelFormat::kMono8,
                              PixelFormat::kBayerRg8, PixelFormat::kBayerGr8, PixelFormat::kBayerGb8,
                              PixelFormat::kBayerBg8};

Picture draw(Scene scene, int width, int height, Random& random) {
  Picture picture(width, height);
  if (scene == Scene::kNoise) {
    picture.randomise(random);
    return picture;
  }
  const bool is_green = scene == Scene::kAllMarker || scene == Scene::kHoles;
  picture.fill(is_green ? 50 : 105, is_green ? 190 : 115, is_green ? 55 : 125);
  if (scene == Scene::kBlocks) picture.drawRandomBlocks(random, 8, 0.6);
  if (scene == Scene::kHalfMarker)
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < (width + 1) / 2; ++x)
        std::copy_n(std::array<std::uint8_t, 3>{50, 190, 55}.data(), 3, picture.pixel(x, y));
  const int discs = scene == Scene::kBalls ? 4 : scene == Scene::kClutter ? 40 : 0;
  for (int i = 0; i < discs; ++i)
    picture.drawDisc(random.uniform(0, width), random.uniform(0, height), random.uniform(2, 8), 45, 190, 50);
  if (scene == Scene::kHoles)
    for (int i = 0; i < 3; ++i)
      picture.drawDisc(random.uniform(0, width), random.uniform(0, height), random.uniform(1, 6), 105, 115,
                       125);
  picture.addNoise(random, 4.0);
  return picture;
}

struct Case {
  const char* name;
  ColourRange colour;
  int opening;
  int closing;
};

const std::vector<Case>& cases() {
  static const std::vector<Case> all{
      {"green", {}, 3, 3},
      {"green, wide squares", {}, 5, 5},
      {"green, without opening", {}, 1, 3},
      {"green, without either", {}, 1, 1},
      {"green, pale ones too", {35, 85, 20, 255, 30, 255}, 7, 3},
      {"red through 0", {170, 10, 60, 255, 40, 255}, 3, 3},
      {"yellow", {22, 38, 60, 255, 40, 255}, 3, 3},
      {"blue to magenta", {110, 155, 60, 255, 40, 255}, 3, 1},
      {"every hue", {0, 179, 40, 255, 0, 255}, 3, 3},
      {"all but green", {90, 30, 40, 255, 0, 255}, 3, 3},
      {"pale and bright", {0, 179, 0, 40, 100, 255}, 3, 5},
      {"dark", {0, 179, 0, 255, 0, 90}, 3, 3},
      {"a thin slice", {60, 61, 100, 180, 90, 210}, 1, 1},
      {"nothing", {0, 0, 255, 255, 0, 0}, 3, 3},
  };
  return all;
}

auto ordered(std::span<const Region> regions) {
  std::vector<std::array<std::int64_t, 7>> list;
  for (const Region& r : regions)
    list.push_back({r.area, r.sum_x, r.sum_y, r.left, r.top, r.right, r.bottom});
  std::sort(list.begin(), list.end());
  return list;
}

bool isSame(const BinaryMask& a, const BinaryMask& b) {
  for (int y = 0; y < a.height(); ++y)
    if (!std::equal(a.row(y), a.row(y) + a.wordsPerRow(), b.row(y))) return false;
  return a.width() == b.width() && a.height() == b.height();
}

BinaryMask someAreas(const CellGrid& grid, Random& random) {
  BinaryMask mask;
  mask.resize(grid.width, grid.height);
  for (int y = 0; y < grid.height; ++y)
    for (int w = 0; w < mask.wordsPerRow(); ++w)
      if (random.uniform() < 0.2) mask.row(y)[w] = random.bits() & (random.bits() | 0xFFFFU);
  return mask;
}

class RegionFinderEqualsReference : public testing::TestWithParam<std::string> {
 protected:
  void SetUp() override { useInstructionSet(GetParam()); }
  void TearDown() override { useInstructionSet({}); }

  const ColourClass* classFor(const ColourRange& colour, const CellGrid& grid) {
    if (grid.layout == CellLayout::kBytes) return nullptr;
    held_.push_back(
        ColourClass::of(colour, grid.red_first ? ColourClass::Order::kRgb : ColourClass::Order::kBgr));
    return held_.back().get();
  }

  void compare(const Picture& picture, const Picture* empty, const Case& c, bool with_ignored,
               Random& random) {
    const CellGrid grid(picture.view());
    BackgroundRanges ranges;
    if (empty != nullptr) ranges.measure(CellGrid(empty->view()));
    const BackgroundCells behind =
        empty != nullptr
            ? BackgroundCells(CellGrid(empty->view()), random.uniform() < 0.7 ? &ranges : nullptr)
            : BackgroundCells();
    const BinaryMask ignored = someAreas(grid, random);
    const BinaryMask* hidden = with_ignored ? &ignored : nullptr;
    MarkerOptions options;
    const auto inPixels = [&](int side) { return grid.hasQuads() ? 2 * side - 1 : side; };
    options.opening_px = inPixels(c.opening);
    options.closing_px = inPixels(c.closing);
    const CellRule rule{classFor(c.colour, grid), static_cast<std::uint8_t>(c.colour.value_low),
                        static_cast<std::uint8_t>(c.colour.value_high),
                        static_cast<std::uint8_t>(options.background_threshold)};
    RegionFinder finder(c.opening, c.closing);
    finder.resize(grid.width, grid.height);
    const ImageView empty_view = empty != nullptr ? empty->view() : ImageView{};
    BinaryMask mask, expected_mask;
    mask.resize(grid.width, grid.height);
    const auto expected = ordered(referenceRegions(picture.view(), empty != nullptr ? &empty_view : nullptr,
                                                   c.colour, options, hidden, &expected_mask));
    for (int repeat = 0; repeat < 2; ++repeat) {  // the second finds what the first left behind
      const auto found =
          ordered(finder.find(grid, empty != nullptr ? &behind : nullptr, rule, hidden, &mask));
      ASSERT_EQ(found, expected);
      ASSERT_TRUE(isSame(mask, expected_mask));
    }
    regions_ += expected.size();
  }

  std::size_t regions_ = 0;

 private:
  std::vector<std::shared_ptr<const ColourClass>> held_;
};

TEST_P(RegionFinderEqualsReference, InEveryRegionAndTheMask) {
  ASSERT_EQ(instructionSet(), GetParam());
  constexpr std::array<std::array<int, 2>, 8> kSizes{
      {{160, 120}, {64, 64}, {193, 71}, {127, 40}, {37, 53}, {320, 90}, {5, 4}, {130, 3}}};
  Random random(42);
  for (const Case& c : cases())
    for (const Scene scene : kScenes)
      for (const auto& [width, height] : kSizes) {
        const Picture picture = draw(scene, width, height, random),
                      empty = draw(scene, width, height, random);
        const PixelFormat format = kFormats[static_cast<std::size_t>(random.uniform(0, kFormats.size()))];
        const int padding = static_cast<int>(random.uniform(0, 5));
        const bool with_background = random.uniform() < 0.6, with_ignored = random.uniform() < 0.3;
        SCOPED_TRACE(testing::Message()
                     << c.name << ", scene " << static_cast<int>(scene) << ", " << width << "x" << height
                     << ", format " << static_cast<int>(format) << ", background " << with_background
                     << ", ignored " << with_ignored);
        const Picture behind = empty.as(format, padding);
        compare(picture.as(format, padding), with_background ? &behind : nullptr, c, with_ignored, random);
      }
  EXPECT_GT(regions_, 3000U);
}

TEST_P(RegionFinderEqualsReference, InEveryFormat) {
  Random random(7);
  for (const PixelFormat format : kFormats)
    for (const Scene scene : kScenes) {
      SCOPED_TRACE(testing::Message()
                   << "format " << static_cast<int>(format) << ", scene " << static_cast<int>(scene));
      const Picture empty = draw(Scene::kBalls, 267, 133, random).as(format, 1);
      compare(draw(scene, 267, 133, random).as(format, 1), &empty, cases().front(), false, random);
    }
}

INSTANTIATE_TEST_SUITE_P(InstructionSets, RegionFinderEqualsReference, testing::ValuesIn(instructionSets()),
                         [](const auto& parameter) { return parameter.param; });

TEST(RegionFinder, SeesRegionsThatOnlyTheClosingJoins) {
  Picture picture(200, 60);
  picture.fill(120, 120, 120);
  // Squares a column apart, across a word's edge, and two rows apart.
  for (const auto& [x, y] : {std::pair{58, 10}, {62, 10}, {66, 10}, {140, 30}, {140, 34}})
    for (int dy = 0; dy < 3; ++dy)
      for (int dx = 0; dx < 3; ++dx)
        std::copy_n(std::array<std::uint8_t, 3>{45, 190, 50}.data(), 3, picture.pixel(x + dx, y + dy));
  const CellGrid grid(picture.view());
  const auto colours = ColourClass::of({}, ColourClass::Order::kBgr);
  RegionFinder finder(3, 3);
  finder.resize(grid.width, grid.height);
  EXPECT_EQ(ordered(finder.find(grid, nullptr, {colours.get(), 0, 255, 20})),
            ordered(referenceRegions(picture.view(), nullptr, {}, {})));
  EXPECT_EQ(finder.find(grid, nullptr, {colours.get(), 0, 255, 20}).size(), 2U);
}

TEST(ColourBounds, HoldForEveryColour) {
  for (const ColourClass::Order order : {ColourClass::Order::kBgr, ColourClass::Order::kRgb})
    for (const Case& c : cases()) {
      SCOPED_TRACE(c.name);
      const ColourClass colours(c.colour, order);
      const ColourBounds& b = colours.bounds();
      int wrong = 0;
      for (std::uint32_t i = 0; i < 1U << 24; i += 1 + i % 5) {
        const std::array<int, 3> v{static_cast<int>(i & 255U), static_cast<int>(i >> 8 & 255U),
                                   static_cast<int>(i >> 16)};
        const int special = v[b.special], x = v[static_cast<std::size_t>(otherA(b.special))],
                  y = v[static_cast<std::size_t>(otherB(b.special))];
        const int brightest = std::max({special, x, y}), darkest = std::min({special, x, y});
        const bool inner = b.has_inner && special == brightest && special >= b.inner_value_low &&
                           special <= b.inner_value_high && darkest <= b.inner_darkest_at_most.of(special) &&
                           x - y <= b.inner_a_over_b.of(special - darkest) &&
                           y - x <= b.inner_b_over_a.of(special - darkest);
        bool outer = brightest >= b.value_low && brightest - darkest >= b.chroma &&
                     darkest <= b.darkest_at_most.of(brightest);
        if (b.shape == ColourBounds::Shape::kDominant) outer &= std::max(x, y) <= special - b.lead;
        if (b.shape == ColourBounds::Shape::kRecessive) outer &= std::min(x, y) >= special + b.lead;
        if (b.shape == ColourBounds::Shape::kAny) outer &= darkest >= b.darkest_at_least.of(brightest);
        const bool is_in = colours.contains(i);
        const std::array<std::uint8_t, 3> bytes{static_cast<std::uint8_t>(v[0]),
                                                static_cast<std::uint8_t>(v[1]),
                                                static_cast<std::uint8_t>(v[2])};
        wrong += (is_in && !outer) || (inner && !is_in) || colours.contains(bytes.data()) != is_in ? 1 : 0;
      }
      EXPECT_EQ(wrong, 0);
    }
}

TEST(ColourBounds, GrowBoxesThatHoldColoursOfTheClassOnly) {
  Random random(3);
  const auto byte = [&random] { return static_cast<int>(random.uniform(0, 256)); };
  const auto byteFrom = [&random](int low, int high) {
    return static_cast<std::uint32_t>(low + static_cast<int>(random.uniform(0, high - low + 1)));
  };
  int grown = 0;
  for (const Case& c : cases()) {
    SCOPED_TRACE(c.name);
    const ColourClass colours(c.colour, ColourClass::Order::kBgr);
    for (int i = 0; i < 20000; ++i) {
      ColourBox box;
      for (std::size_t k = 0; k < 3; ++k) box.low[k] = box.high[k] = static_cast<std::uint8_t>(byte());
      const auto larger = grownInside(colours.bounds(), box);
      if (!larger) continue;
      ++grown;
      for (int sample = 0; sample < 30; ++sample) {
        std::uint32_t colour = 0;
        for (std::size_t k = 0; k < 3; ++k) {
          ASSERT_LE(larger->low[k], box.low[k]);
          ASSERT_GE(larger->high[k], box.high[k]);
          // Its corners first.
          const std::uint32_t value = sample < 8 ? (sample >> k & 1) != 0 ? larger->high[k] : larger->low[k]
                                                 : byteFrom(larger->low[k], larger->high[k]);
          colour |= value << (8 * k);
        }
        ASSERT_TRUE(colours.contains(colour));
      }
    }
  }
  EXPECT_GT(grown, 5000);
}

}  // namespace
}  // namespace helical
