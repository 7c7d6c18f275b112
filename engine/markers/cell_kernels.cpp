#include "engine/markers/cell_kernels.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

// clang-format off: foreach_target.h includes this file once per instruction set.
#define HWY_WANT_AVX3_DL
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/markers/cell_kernels.cpp"
#include <hwy/cache_control.h>
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace helical {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using Shape = ColourBounds::Shape;
using Tag = hn::CappedTag<std::uint8_t, 64>;
using Bytes = hn::Vec<Tag>;

constexpr int kBelowWorthVectors = 8;  ///< so many candidates of a word are looked up one by one

struct Colours {
  Bytes first, green, last;
};

HWY_INLINE Bytes broadcast(int value) {
  return hn::Set(Tag(), static_cast<std::uint8_t>(value));
}

/// `ByteLine::of` for a vector.
class Line {
 public:
  HWY_INLINE explicit Line(const ByteLine& line)
      : whole_(broadcast(line.eighths == 8 ? 255 : 0)),
        eighth_(broadcast((line.eighths & 1) != 0 || line.eighths == 8 ? 255 : 0)),
        quarter_(broadcast((line.eighths & 2) != 0 || line.eighths == 8 ? 255 : 0)),
        half_(broadcast((line.eighths & 4) != 0 || line.eighths == 8 ? 255 : 0)),
        less_(broadcast(line.less)) {}

  HWY_INLINE Bytes of(Bytes x) const {
    Bytes y = hn::AverageRound(hn::And(x, whole_), hn::And(x, eighth_));
    y = hn::AverageRound(y, hn::And(x, quarter_));
    y = hn::AverageRound(y, hn::And(x, half_));
    return hn::SaturatedSub(y, less_);
  }

 private:
  Bytes whole_, eighth_, quarter_, half_, less_;
};

/// Pointers to a cell's bytes; `second` for quads only.
struct Place {
  const std::uint8_t* first;
  const std::uint8_t* second;
};

template <CellLayout L>
constexpr int kBytesPerCell = L == CellLayout::kBytes     ? 1
                              : L == CellLayout::kTriples ? 3
                                                          : 2;

template <CellLayout L>
constexpr bool kHasQuads = L == CellLayout::kQuadsColourFirst || L == CellLayout::kQuadsGreenFirst;

/// Bytes that are fetched for a word, and how far before they are needed: memory answers after the time that
/// so many take to test.
template <CellLayout L>
constexpr int kFetched = 64 * (kHasQuads<L> ? 2 : 1) * kBytesPerCell<L>;
constexpr int kBytesAhead = 4096;
/// Words with candidates whose surroundings are fetched; where there are more, the frame is read as a whole.
constexpr int kFetchedAround = 256;

/// How far vector k of as many as a cell has bytes begins behind the one before: cells begin in other lanes
/// of each, so that all together fill one vector's lanes.
template <CellLayout L>
constexpr std::size_t vectorBegin(std::size_t k) {
  return k * (hn::MaxLanes(Tag()) - (kHasQuads<L> ? 1 : 0));
}

/// 255 in the lanes of vector k in which cells begin.
template <CellLayout L, std::size_t k>
struct BeginsOfCells {
  constexpr BeginsOfCells() {
    for (std::size_t i = 0; i < lanes.size(); ++i)
      lanes[i] = (vectorBegin<L>(k) + i) % kBytesPerCell<L> == 0 ? 255 : 0;
  }
  alignas(64) std::array<std::uint8_t, 64> lanes{};
};
template <CellLayout L, std::size_t k>
constexpr BeginsOfCells<L, k> kBeginsOfCells;

// The better a target, the smaller its number.
#if HWY_TARGET <= HWY_AVX3_DL
/// Sorts three vectors of triples by lookups in two tables of bytes, which Highway does not have: a third of
/// the operations of hn::LoadInterleaved3.
constexpr bool kSortsQuickly = true;

template <int kChannel>
struct BytesOfChannel {
  constexpr BytesOfChannel() {
    for (std::size_t i = 0; i < place.size(); ++i) place[i] = static_cast<std::uint8_t>(3 * i + kChannel);
  }
  alignas(64) std::array<std::uint8_t, 64> place{};
};
template <int kChannel>
constexpr BytesOfChannel<kChannel> kBytesOfChannel;

template <int kChannel>
HWY_INLINE Bytes channelOf(Bytes a, Bytes b, Bytes c) {
  // Bytes 128 to 191 are those of c.
  constexpr int kFirstOfC = (128 - kChannel + 2) / 3;
  const Bytes place = hn::Load(Tag(), kBytesOfChannel<kChannel>.place.data());
  const __m512i of_a_and_b = _mm512_permutex2var_epi8(a.raw, place.raw, b.raw);
  return Bytes{_mm512_mask_permutexvar_epi8(of_a_and_b, ~std::uint64_t{0} << kFirstOfC, place.raw, c.raw)};
}

HWY_INLINE Colours loadTriples(const std::uint8_t* from) {
  const Tag d;
  const Bytes a = hn::LoadU(d, from), b = hn::LoadU(d, from + 64), c = hn::LoadU(d, from + 128);
  return {channelOf<0>(a, b, c), channelOf<1>(a, b, c), channelOf<2>(a, b, c)};
}
#else
constexpr bool kSortsQuickly = false;

HWY_INLINE Colours loadTriples(const std::uint8_t* from) {
  Colours c;
  hn::LoadInterleaved3(Tag(), from, c.first, c.green, c.last);
  return c;
}
#endif

template <CellLayout L>
HWY_INLINE Colours loadColours(const Place& place, std::size_t cell) {
  const Tag d;
  Colours c;
  if constexpr (L == CellLayout::kTriples) {
    c = loadTriples(place.first + 3 * cell);
  } else {
    Bytes upper_even, upper_odd, lower_even, lower_odd;
    hn::LoadInterleaved2(d, place.first + 2 * cell, upper_even, upper_odd);
    hn::LoadInterleaved2(d, place.second + 2 * cell, lower_even, lower_odd);
    if constexpr (L == CellLayout::kQuadsColourFirst) {
      c = {upper_even, hn::AverageRound(upper_odd, lower_even), lower_odd};
    } else {
      c = {upper_odd, hn::AverageRound(upper_even, lower_odd), lower_even};
    }
  }
  return c;
}

/// The same without sorting the bytes: lane i has the colours of the cell that begins at byte `byte` + i, or
/// nonsense where none does. Reads up to two bytes further.
template <CellLayout L>
HWY_INLINE Colours loadWhereCellsBegin(const Place& place, std::size_t byte) {
  const Tag d;
  const std::uint8_t* first = place.first + byte;
  if constexpr (L == CellLayout::kTriples) {
    return {hn::LoadU(d, first), hn::LoadU(d, first + 1), hn::LoadU(d, first + 2)};
  } else {
    const std::uint8_t* second = place.second + byte;
    const Bytes upper = hn::LoadU(d, first), upper_next = hn::LoadU(d, first + 1);
    const Bytes lower = hn::LoadU(d, second), lower_next = hn::LoadU(d, second + 1);
    if constexpr (L == CellLayout::kQuadsColourFirst)
      return {upper, hn::AverageRound(upper_next, lower), lower_next};
    else
      return {upper_next, hn::AverageRound(upper, lower_next), lower};
  }
}

HWY_INLINE std::uint64_t bitsOf(hn::Mask<Tag> mask) {
  std::uint8_t bytes[8] = {};
  hn::StoreMaskBits(Tag(), mask, bytes);
  std::uint64_t bits;
  std::memcpy(&bits, bytes, sizeof bits);
  return bits;
}

HWY_INLINE Bytes difference(Bytes a, Bytes b) {
  return hn::Or(hn::SaturatedSub(a, b), hn::SaturatedSub(b, a));
}

HWY_INLINE Bytes largestDifference(const Colours& c, const Colours& b) {
  return hn::Max(hn::Max(difference(c.first, b.first), difference(c.green, b.green)),
                 difference(c.last, b.last));
}

template <CellLayout L, std::size_t k>
HWY_INLINE void putWhereCellsBegin(const Place& place, std::size_t byte, Colours& to) {
  const auto where = hn::MaskFromVec(hn::Load(Tag(), kBeginsOfCells<L, k>.lanes.data()));
  const Colours from = loadWhereCellsBegin<L>(place, byte + vectorBegin<L>(k));
  to = {hn::IfThenElse(where, from.first, to.first), hn::IfThenElse(where, from.green, to.green),
        hn::IfThenElse(where, from.last, to.last)};
}

/// As many cells as a vector has lanes, from byte `byte` on, each in some lane.
template <CellLayout L>
HWY_INLINE Colours loadInAnyOrder(const Place& place, std::size_t byte) {
  if constexpr (kSortsQuickly && L == CellLayout::kTriples) {
    return loadTriples(place.first + byte);
  } else {
    Colours c = loadWhereCellsBegin<L>(place, byte);
    putWhereCellsBegin<L, 1>(place, byte, c);
    if constexpr (L == CellLayout::kTriples) putWhereCellsBegin<L, 2>(place, byte, c);
    return c;
  }
}

/// The outer bounds of a class: which cells may be of it.
template <Shape S>
class OuterBounds {
 public:
  explicit OuterBounds(const ColourBounds& b)
      : special_(b.special),
        lead_(broadcast(b.lead)),
        chroma_(broadcast(b.chroma)),
        value_low_(broadcast(b.value_low)),
        darkest_at_most_(b.darkest_at_most),
        darkest_at_least_(b.darkest_at_least) {}

  HWY_INLINE hn::Mask<Tag> mayHold(const Colours& c) const {
    if (special_ == 1) return test(c.green, c.last, c.first);
    return special_ == 0 ? test(c.first, c.green, c.last) : test(c.last, c.first, c.green);
  }

  /// Whether the bounds have a part that is cheap to test and that most cells fail, and that part: 0 where
  /// they pass.
  static constexpr bool kHasFirstTest = S != Shape::kAny;
  HWY_INLINE Bytes failFirstTest(const Colours& c) const {
    if (special_ == 1) return firstTest(c.green, c.last, c.first);
    return special_ == 0 ? firstTest(c.first, c.green, c.last) : firstTest(c.last, c.first, c.green);
  }

 private:
  HWY_INLINE Bytes firstTest(Bytes special, Bytes a, Bytes b) const {
    const Bytes more = hn::Max(a, b), less = hn::Min(a, b);
    if constexpr (S == Shape::kDominant)
      return hn::Or(hn::SaturatedSub(more, hn::SaturatedSub(special, lead_)),
                    hn::SaturatedSub(less, hn::SaturatedSub(special, chroma_)));
    else
      return hn::Or(hn::SaturatedSub(hn::SaturatedAdd(special, lead_), less),
                    hn::SaturatedSub(hn::SaturatedAdd(special, chroma_), more));
  }

  HWY_INLINE hn::Mask<Tag> test(Bytes special, Bytes a, Bytes b) const {
    Bytes more = hn::Max(a, b), less = hn::Min(a, b), out;
    if constexpr (S == Shape::kDominant) {
      out = hn::SaturatedSub(more, hn::SaturatedSub(special, lead_));
      more = special;
    } else if constexpr (S == Shape::kRecessive) {
      out = hn::SaturatedSub(hn::SaturatedAdd(special, lead_), less);
      less = special;
    } else {
      more = hn::Max(more, special);
      less = hn::Min(less, special);
      out = hn::SaturatedSub(darkest_at_least_.of(more), less);
    }
    out = hn::Or(out, hn::SaturatedSub(value_low_, more));
    out = hn::Or(out, hn::SaturatedSub(less, darkest_at_most_.of(more)));
    return hn::Eq(out, hn::Zero(Tag()));
  }

  int special_;
  Bytes lead_, chroma_, value_low_;
  Line darkest_at_most_, darkest_at_least_;
};

class BrightnessBounds {
 public:
  explicit BrightnessBounds(const CellRule& rule)
      : low_(broadcast(rule.brightness_low)), high_(broadcast(rule.brightness_high)) {}

  HWY_INLINE hn::Mask<Tag> holds(Bytes v) const {
    return hn::Eq(hn::Or(hn::SaturatedSub(low_, v), hn::SaturatedSub(v, high_)), hn::Zero(Tag()));
  }

 private:
  Bytes low_, high_;
};

/// The inner bounds of a class: which cells are of it for certain.
class InnerBounds {
 public:
  explicit InnerBounds(const ColourBounds& b)
      : exists_(b.has_inner),
        special_(b.special),
        value_low_(broadcast(b.inner_value_low)),
        value_high_(broadcast(b.inner_value_high)),
        darkest_at_most_(b.inner_darkest_at_most),
        a_over_b_(b.inner_a_over_b),
        b_over_a_(b.inner_b_over_a) {}

  HWY_INLINE std::uint64_t surelyHold(const Colours& c) const {
    if (!exists_) return 0;
    if (special_ == 1) return test(c.green, c.last, c.first);
    return special_ == 0 ? test(c.first, c.green, c.last) : test(c.last, c.first, c.green);
  }

 private:
  HWY_INLINE std::uint64_t test(Bytes special, Bytes a, Bytes b) const {
    const Bytes more = hn::Max(a, b), less = hn::Min(a, b), chroma = hn::SaturatedSub(special, less);
    Bytes out = hn::Or(hn::SaturatedSub(more, special), hn::SaturatedSub(value_low_, special));
    out = hn::Or(out, hn::SaturatedSub(special, value_high_));
    out = hn::Or(out, hn::SaturatedSub(less, darkest_at_most_.of(special)));
    out = hn::Or(out, hn::SaturatedSub(hn::SaturatedSub(a, b), a_over_b_.of(chroma)));
    out = hn::Or(out, hn::SaturatedSub(hn::SaturatedSub(b, a), b_over_a_.of(chroma)));
    return bitsOf(hn::Eq(out, hn::Zero(Tag())));
  }

  bool exists_;
  int special_;
  Bytes value_low_, value_high_;
  Line darkest_at_most_, a_over_b_, b_over_a_;
};

/// The cells of one word with room behind them for whole vectors: copied if the row ends before.
template <CellLayout L>
class WordCells {
 public:
  static constexpr int kWordBytes = 64 * kBytesPerCell<L>;

  HWY_INLINE WordCells(const CellGrid& grid, int y, int word) {
    place_.first = grid.row(y) + static_cast<std::ptrdiff_t>(word) * kWordBytes;
    place_.second = place_.first + grid.second_row;
    if (word * 64 + 64 <= grid.width) return;
    const auto bytes = static_cast<std::size_t>(grid.width - word * 64) * kBytesPerCell<L>;
    std::memset(copy_, 0, sizeof copy_);
    std::memcpy(copy_[0], place_.first, bytes);
    if (grid.hasQuads()) std::memcpy(copy_[1], place_.second, bytes);
    place_ = {copy_[0], copy_[1]};
  }
  WordCells(const WordCells&) = delete;

  const Place& place() const { return place_; }

 private:
  Place place_;
  alignas(64) std::uint8_t copy_[2][kWordBytes];
};

HWY_INLINE std::uint64_t cellsOfWord(const CellGrid& grid, int word) {
  const int cells = grid.width - word * 64;
  return cells >= 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << cells) - 1;
}

template <CellLayout L>
HWY_INLINE void readColour(const Place& place, int cell, std::uint8_t* c) {
  const std::uint8_t* p = place.first + kBytesPerCell<L> * cell;
  if constexpr (L == CellLayout::kTriples) {
    c[0] = p[0], c[1] = p[1], c[2] = p[2];
  } else {
    const std::uint8_t* q = place.second + 2 * cell;
    constexpr int kGreen = L == CellLayout::kQuadsGreenFirst ? 0 : 1;
    c[0] = p[1 - kGreen], c[1] = static_cast<std::uint8_t>((p[kGreen] + q[1 - kGreen] + 1) / 2),
    c[2] = q[kGreen];
  }
}

/// Exact classification of words, three channels.
template <CellLayout L, Shape S>
class ColourRefiner {
 public:
  ColourRefiner(const CellGrid& grid, const CellGrid* background, const CellRule& rule)
      : grid_(grid),
        background_(background),
        colours_(*rule.colours),
        outer_(colours_.bounds()),
        inner_(colours_.bounds()),
        threshold_(rule.background_threshold) {}

  /// Whether a whole word holds no candidate, in a third of the time of finding them: enough for most. False:
  /// it may hold some. Reads two bytes behind the word.
  HWY_INLINE bool holdsNone(const Place& place) const {
    if constexpr (!OuterBounds<S>::kHasFirstTest) return false;
    const Tag d;
    Bytes least = broadcast(255);
    for (std::size_t cell = 0; cell < 64; cell += hn::Lanes(d))
      least = hn::Min(least, outer_.failFirstTest(loadInAnyOrder<L>(place, cell * kBytesPerCell<L>)));
    return hn::AllFalse(d, hn::Eq(least, hn::Zero(d)));
  }

  HWY_INLINE std::uint64_t candidates(const Place& place) const {
    const std::size_t lanes = hn::Lanes(Tag());
    std::uint64_t bits = 0;
    for (std::size_t k = 0; k < 64; k += lanes) bits |= bitsOf(outer_.mayHold(loadColours<L>(place, k))) << k;
    return bits;
  }

  HWY_INLINE std::uint64_t classify(int y, int word) const {
    const WordCells<L> cells(grid_, y, word);
    const std::uint64_t bits = candidates(cells.place()) & cellsOfWord(grid_, word);
    return bits == 0 ? 0 : refineAt(cells.place(), y, word, bits);
  }

  /// The same in one pass over the word: faster where most of them hold something.
  HWY_INLINE std::uint64_t classifyFull(int y, int word) const {
    const WordCells<L> cells(grid_, y, word);
    const std::uint64_t used = cellsOfWord(grid_, word);
    if (background_ == nullptr) return decide(cells.place(), used);
    const WordCells<L> behind(*background_, y, word);
    return decide(cells.place(), used & differing(cells.place(), behind.place()));
  }

  HWY_INLINE std::uint64_t refine(int y, int word, std::uint64_t bits) const {
    const WordCells<L> cells(grid_, y, word);
    return refineAt(cells.place(), y, word, bits);
  }

 private:
  HWY_INLINE std::uint64_t refineAt(const Place& place, int y, int word, std::uint64_t bits) const {
    if (std::popcount(bits) < kBelowWorthVectors) return lookUpEach(place, y, word, bits);
    if (background_ != nullptr) bits &= foreground(place, y, word);
    if (bits == 0) return 0;
    const std::size_t lanes = hn::Lanes(Tag());
    std::uint64_t sure = 0;
    for (std::size_t k = 0; k < 64; k += lanes) sure |= inner_.surelyHold(loadColours<L>(place, k)) << k;
    return (bits & sure) | lookUp(place, bits & ~sure);
  }

  /// Which of these cells are of the class, by vectors: most of them for certain.
  HWY_INLINE std::uint64_t decide(const Place& place, std::uint64_t bits) const {
    if (bits == 0) return 0;
    const std::size_t lanes = hn::Lanes(Tag());
    std::uint64_t sure = 0;
    for (std::size_t k = 0; k < 64; k += lanes) sure |= inner_.surelyHold(loadColours<L>(place, k)) << k;
    const std::uint64_t open = bits & ~sure;
    return (bits & sure) | (open == 0 ? 0 : lookUp(place, open & candidates(place)));
  }

  HWY_INLINE std::uint64_t lookUp(const Place& place, std::uint64_t bits) const {
    std::uint64_t taken = 0;
    for (; bits != 0; bits &= bits - 1) {
      const int cell = std::countr_zero(bits);
      std::uint8_t c[3];
      readColour<L>(place, cell, c);
      taken |= static_cast<std::uint64_t>(colours_.contains(c)) << cell;
    }
    return taken;
  }

  HWY_INLINE std::uint64_t lookUpEach(const Place& place, int y, int word, std::uint64_t bits) const {
    bits = lookUp(place, bits);
    if (bits == 0 || background_ == nullptr) return bits;
    const std::uint8_t* first =
        background_->row(y) + static_cast<std::ptrdiff_t>(word) * 64 * kBytesPerCell<L>;
    const Place behind{first, first + background_->second_row};
    std::uint64_t taken = 0;
    for (; bits != 0; bits &= bits - 1) {
      const int cell = std::countr_zero(bits);
      std::uint8_t c[3], b[3];
      readColour<L>(place, cell, c);
      readColour<L>(behind, cell, b);
      const int most = std::max({std::abs(c[0] - b[0]), std::abs(c[1] - b[1]), std::abs(c[2] - b[2])});
      taken |= static_cast<std::uint64_t>(most > threshold_) << cell;
    }
    return taken;
  }

  HWY_INLINE std::uint64_t foreground(const Place& place, int y, int word) const {
    const WordCells<L> behind(*background_, y, word);
    return differing(place, behind.place());
  }

  HWY_INLINE std::uint64_t differing(const Place& place, const Place& behind) const {
    const Bytes threshold = broadcast(threshold_);
    const std::size_t lanes = hn::Lanes(Tag());
    std::uint64_t bits = 0;
    for (std::size_t k = 0; k < 64; k += lanes) {
      const Colours c = loadColours<L>(place, k), b = loadColours<L>(behind, k);
      const Bytes most = largestDifference(c, b);
      bits |= bitsOf(hn::Ne(hn::SaturatedSub(most, threshold), hn::Zero(Tag()))) << k;
    }
    return bits;
  }

  const CellGrid& grid_;
  const CellGrid* background_;
  const ColourClass& colours_;
  OuterBounds<S> outer_;
  InnerBounds inner_;
  int threshold_;
};

/// Exact classification of words, brightness.
class BrightnessRefiner {
 public:
  BrightnessRefiner(const CellGrid& grid, const CellGrid* background, const CellRule& rule)
      : grid_(grid), background_(background), bounds_(rule), threshold_(rule.background_threshold) {}

  HWY_INLINE bool holdsNone(const Place&) const { return false; }

  HWY_INLINE std::uint64_t candidates(const Place& place) const {
    const std::size_t lanes = hn::Lanes(Tag());
    std::uint64_t bits = 0;
    for (std::size_t k = 0; k < 64; k += lanes)
      bits |= bitsOf(bounds_.holds(hn::LoadU(Tag(), place.first + k))) << k;
    return bits;
  }

  HWY_INLINE std::uint64_t classify(int y, int word) const {
    const WordCells<CellLayout::kBytes> cells(grid_, y, word);
    const std::uint64_t bits = candidates(cells.place()) & cellsOfWord(grid_, word);
    return bits == 0 ? 0 : refine(y, word, bits);
  }

  HWY_INLINE std::uint64_t classifyFull(int y, int word) const { return classify(y, word); }

  HWY_INLINE std::uint64_t refine(int y, int word, std::uint64_t bits) const {
    if (background_ == nullptr) return bits;
    const WordCells<CellLayout::kBytes> cells(grid_, y, word), behind(*background_, y, word);
    const Bytes threshold = broadcast(threshold_);
    const std::size_t lanes = hn::Lanes(Tag());
    std::uint64_t foreground = 0;
    for (std::size_t k = 0; k < 64; k += lanes) {
      const Bytes away =
          difference(hn::LoadU(Tag(), cells.place().first + k), hn::LoadU(Tag(), behind.place().first + k));
      foreground |= bitsOf(hn::Ne(hn::SaturatedSub(away, threshold), hn::Zero(Tag()))) << k;
    }
    return bits & foreground;
  }

 private:
  const CellGrid& grid_;
  const CellGrid* background_;
  BrightnessBounds bounds_;
  int threshold_;
};

/// Calls `use` with the refiner for this layout and this class, and with the layout.
template <CellLayout L, class Use>
HWY_INLINE void withColourRefiner(const CellGrid& grid, const CellGrid* background, const CellRule& rule,
                                  Use& use) {
  switch (rule.colours->bounds().shape) {
    case Shape::kDominant:
      return use.template operator()<L>(ColourRefiner<L, Shape::kDominant>(grid, background, rule));
    case Shape::kRecessive:
      return use.template operator()<L>(ColourRefiner<L, Shape::kRecessive>(grid, background, rule));
    case Shape::kAny:
      return use.template operator()<L>(ColourRefiner<L, Shape::kAny>(grid, background, rule));
  }
}

template <class Use>
HWY_INLINE void withRefiner(const CellGrid& grid, const CellGrid* background, const CellRule& rule, Use use) {
  switch (grid.layout) {
    case CellLayout::kBytes:
      return use.template operator()<CellLayout::kBytes>(BrightnessRefiner(grid, background, rule));
    case CellLayout::kTriples:
      return withColourRefiner<CellLayout::kTriples>(grid, background, rule, use);
    case CellLayout::kQuadsColourFirst:
      return withColourRefiner<CellLayout::kQuadsColourFirst>(grid, background, rule, use);
    case CellLayout::kQuadsGreenFirst:
      return withColourRefiner<CellLayout::kQuadsGreenFirst>(grid, background, rule, use);
  }
}

/// Whether these candidates may be part of a run of `length`, here or over an end of the word.
HWY_INLINE bool mayHoldRun(std::uint64_t bits, int length) {
  constexpr std::uint64_t kEnds = std::uint64_t{1} << 63 | 1;
  std::uint64_t runs = bits;
  for (int i = 1; i < length; ++i) runs &= bits >> i;
  return (runs | (bits & kEnds)) != 0;
}

struct FindInRows {
  const CellGrid& grid;
  const CellGrid* background;
  const ScannedRows& rows;
  int first_word, end_word, most;
  CellWord* found;
  int count;

  template <CellLayout L, class Refiner>
  HWY_INLINE void operator()(const Refiner& refiner) {
    CellWord* out = found;
    const int rows_ahead = 1 + kBytesAhead / (kFetched<L> * (end_word - first_word));
    int ahead = rows.first;
    for (int i = 0; i < rows_ahead; ++i, ahead = rows.after(ahead)) fetchRow<L>(ahead);
    for (int y = rows.first; y <= rows.end; y = rows.after(y)) {
      out = findInRow<L>(refiner, y, ahead, out);
      ahead = rows.after(ahead);
      if (out - found > most || y == rows.last) break;
    }
    count = static_cast<int>(out - found);
  }

  template <CellLayout L>
  HWY_INLINE static void fetchWord(const std::uint8_t* cells, std::ptrdiff_t second_row) {
    for (int byte = 0; byte < WordCells<L>::kWordBytes; byte += 64) {
      hwy::Prefetch(cells + byte);
      if constexpr (kHasQuads<L>) hwy::Prefetch(cells + second_row + byte);
    }
  }

  template <CellLayout L>
  HWY_INLINE static void fetchWordOf(const CellGrid& cells, int y, int w) {
    fetchWord<L>(cells.row(y) + w * WordCells<L>::kWordBytes, cells.second_row);
  }

  template <CellLayout L>
  HWY_INLINE void fetchRow(int y) const {
    for (int w = first_word; w < end_word; ++w) fetchWordOf<L>(grid, y, w);
  }

  /// What will be read of this word when the rows are done: as far as a square through it reaches, and the
  /// background. Memory answers while the other rows are tested.
  template <CellLayout L>
  HWY_INLINE void fetchAround(int y, int w) const {
    const int first = std::max(0, y - rows.step + 1), last = std::min(grid.height - 1, y + rows.step - 1);
    for (int row = first; row <= last; ++row) {
      if (row != y) fetchWordOf<L>(grid, row, w);
      if (background != nullptr) fetchWordOf<L>(*background, row, w);
    }
  }

  template <CellLayout L, class Refiner>
  HWY_INLINE CellWord* findInRow(const Refiner& refiner, int y, int row_ahead, CellWord* out) const {
    constexpr int kWordBytes = WordCells<L>::kWordBytes;
    const std::uint8_t* row = grid.row(y);
    const std::uint8_t* ahead = grid.row(row_ahead);
    const int whole_words = std::min(end_word, grid.width / 64);
    // Those behind which there are bytes.
    const int inner_words = y + 1 < grid.height || grid.width % 64 != 0 ? whole_words : whole_words - 1;
    for (int w = first_word; w < whole_words; ++w) {
      fetchWord<L>(ahead + w * kWordBytes, grid.second_row);
      const std::uint8_t* cells = row + w * kWordBytes;
      const Place place{cells, cells + grid.second_row};
      if (w < inner_words && HWY_LIKELY(refiner.holdsNone(place))) continue;
      const std::uint64_t bits = refiner.candidates(place);
      if (!mayHoldRun(bits, rows.step)) continue;
      if (out - found < kFetchedAround) fetchAround<L>(y, w);
      *out++ = {y, w, bits};
    }
    for (int w = std::max(first_word, whole_words); w < end_word; ++w) {
      const WordCells<L> cells(grid, y, w);
      const std::uint64_t bits = refiner.candidates(cells.place()) & cellsOfWord(grid, w);
      if (bits != 0) *out++ = {y, w, bits};
    }
    return out;
  }
};

int findInRows(const CellGrid& grid, const CellGrid* background, const CellRule& rule,
               const ScannedRows& rows, int first_word, int end_word, int most, CellWord* found) {
  int count = 0;
  withRefiner(grid, nullptr, rule, [&]<CellLayout L>(const auto& refiner) HWY_ATTR {
    FindInRows find{grid, background, rows, first_word, end_word, most, found, 0};
    find.template operator()<L>(refiner);
    count = find.count;
  });
  return count;
}

void refineWords(const CellGrid& grid, const CellGrid* background, const CellRule& rule, CellWord* words,
                 std::size_t count) {
  withRefiner(grid, background, rule, [&]<CellLayout L>(const auto& refiner) HWY_ATTR {
    for (std::size_t i = 0; i < count; ++i)
      words[i].bits = refiner.refine(words[i].row, words[i].word, words[i].bits);
  });
}

void classifySome(const CellGrid& grid, const CellGrid* background, const CellRule& rule, CellWord* words,
                  std::size_t count) {
  withRefiner(grid, background, rule, [&]<CellLayout L>(const auto& refiner) HWY_ATTR {
    for (std::size_t i = 0; i < count; ++i) words[i].bits = refiner.classify(words[i].row, words[i].word);
  });
}

void classifyAll(const CellGrid& grid, const CellGrid* background, const CellRule& rule, std::uint64_t* words,
                 std::ptrdiff_t stride) {
  withRefiner(grid, background, rule, [&]<CellLayout L>(const auto& refiner) HWY_ATTR {
    for (int y = 0; y < grid.height; ++y)
      for (int w = 0; w * 64 < grid.width; ++w) words[w * stride + y] = refiner.classifyFull(y, w);
  });
}

const char* nameOfTarget() {
  return hwy::TargetName(HWY_TARGET);
}

}  // namespace HWY_NAMESPACE
}  // namespace helical
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace helical {

HWY_EXPORT(findInRows);
HWY_EXPORT(refineWords);
HWY_EXPORT(classifySome);
HWY_EXPORT(classifyAll);
HWY_EXPORT(nameOfTarget);

int findCandidates(const CellGrid& grid, const CellGrid* background, const CellRule& rule,
                   const ScannedRows& rows, int first_word, int end_word, int most, CellWord* found) {
  return HWY_DYNAMIC_DISPATCH(findInRows)(grid, background, rule, rows, first_word, end_word, most, found);
}

void refineCandidates(const CellGrid& grid, const CellGrid* background, const CellRule& rule,
                      std::span<CellWord> words) {
  HWY_DYNAMIC_DISPATCH(refineWords)(grid, background, rule, words.data(), words.size());
}

void classifyWords(const CellGrid& grid, const CellGrid* background, const CellRule& rule,
                   std::span<CellWord> words) {
  HWY_DYNAMIC_DISPATCH(classifySome)(grid, background, rule, words.data(), words.size());
}

void classifyGrid(const CellGrid& grid, const CellGrid* background, const CellRule& rule,
                  std::uint64_t* words, std::ptrdiff_t stride) {
  HWY_DYNAMIC_DISPATCH(classifyAll)(grid, background, rule, words, stride);
}

std::string instructionSet() {
  return HWY_DYNAMIC_DISPATCH(nameOfTarget)();
}

std::vector<std::string> instructionSets() {
  std::vector<std::string> names;
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets())
    names.emplace_back(hwy::TargetName(target));
  return names;
}

void useInstructionSet(const std::string& name) {
  hwy::SetSupportedTargetsForTest(0);
  if (!name.empty())
    for (const std::int64_t target : hwy::SupportedAndGeneratedTargets())
      if (name == hwy::TargetName(target)) hwy::SetSupportedTargetsForTest(target);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

}  // namespace helical
#endif
