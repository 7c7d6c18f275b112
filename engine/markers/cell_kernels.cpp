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

#include "engine/markers/cell_loading.inc"
#include "engine/markers/colour_tests.inc"
#include "engine/markers/cell_refiners.inc"
#include "engine/markers/cell_boxes.inc"
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace helical {
namespace HWY_NAMESPACE {

/// Bytes that are fetched for a word, and how far before they are needed: memory answers after the time that
/// so many take to test.
template <CellLayout L>
constexpr int kFetched = 64 * (kHasQuads<L> ? 2 : 1) * kBytesPerCell<L>;
constexpr int kBytesAhead = 4096;
/// Words with candidates whose surroundings are fetched; where there are more, the frame is read as a whole.
constexpr int kFetchedAround = 256;
/// Words that are full, yet not of the box's colours, before the box is moved to one: that takes longer than
/// classifying a few.
constexpr int kBeforeMove = 8;

/// Whether these candidates may be part of a run of `length`, here or over an end of the word.
HWY_INLINE bool mayHoldRun(std::uint64_t bits, int length) {
  constexpr std::uint64_t kEnds = std::uint64_t{1} << 63 | 1;
  std::uint64_t runs = bits;
  for (int i = 1; i < length; ++i) runs &= bits >> i;
  return (runs | (bits & kEnds)) != 0;
}

struct FindInRows {
  const CellGrid& grid;
  const BackgroundCells* background;
  const ScannedRows& rows;
  int first_word, end_word, most;
  CellWord* found;
  int count = 0;
  bool is_sparse = true;

  template <CellLayout L, class Refiner>
  HWY_INLINE void operator()(const Refiner& refiner) {
    CellWord* out = found;
    int read = 0;
    const int rows_ahead = 1 + kBytesAhead / (kFetched<L> * (end_word - first_word));
    int ahead = rows.first;
    for (int i = 0; i < rows_ahead; ++i, ahead = rows.after(ahead)) fetchRow<L>(ahead);
    for (int y = rows.first; y <= rows.end; y = rows.after(y)) {
      out = findInRow<L>(refiner, y, ahead, out);
      ahead = rows.after(ahead);
      read += end_word - first_word;
      count = static_cast<int>(out - found);
      // So many of the first rows foretell the rest.
      is_sparse = count <= most / 4 || (count <= most && 2 * count <= read);
      if (!is_sparse || y == rows.last) break;
    }
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
  /// background where that must be known. Memory answers while the other rows are tested.
  template <CellLayout L>
  HWY_INLINE void fetchAround(int y, int w, bool with_background) const {
    const int first = std::max(0, y - rows.step + 1), last = std::min(grid.height - 1, y + rows.step - 1);
    for (int row = first; row <= last; ++row) {
      if (row != y) fetchWordOf<L>(grid, row, w);
      if (with_background) fetchWordOf<L>(*background, row, w);
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
      if (out - found < kFetchedAround) fetchAround<L>(y, w, refiner.maybeBackground(place, y, w, bits) != 0);
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

bool findInRows(const CellGrid& grid, const BackgroundCells* background, const CellRule& rule,
                const ScannedRows& rows, int first_word, int end_word, int most, CellWord* found,
                int& count) {
  bool is_sparse = true;
  withRefiner(grid, background, rule, [&]<CellLayout L>(const auto& refiner) HWY_ATTR {
    FindInRows find{grid, background, rows, first_word, end_word, most, found};
    find.template operator()<L>(refiner);
    count = find.count;
    is_sparse = find.is_sparse;
  });
  return is_sparse;
}

void refineWords(const CellGrid& grid, const BackgroundCells* background, const CellRule& rule,
                 CellWord* words, std::size_t count) {
  withRefiner(grid, background, rule, [&]<CellLayout L>(const auto& refiner) HWY_ATTR {
    for (std::size_t i = 0; i < count; ++i)
      words[i].bits = refiner.refine(words[i].row, words[i].word, words[i].bits);
  });
}

void classifySome(const CellGrid& grid, const BackgroundCells* background, const CellRule& rule,
                  CellWord* words, std::size_t count) {
  withRefiner(grid, background, rule, [&]<CellLayout L>(const auto& refiner) HWY_ATTR {
    for (std::size_t i = 0; i < count; ++i) words[i].bits = refiner.classify(words[i].row, words[i].word);
  });
}

template <CellLayout L, class Refiner>
HWY_INLINE void classifyRows(const Refiner& refiner, const CellGrid& grid, const ColourClass& colours,
                             std::uint64_t* words, std::ptrdiff_t stride) {
  constexpr std::uint64_t kEvery = ~std::uint64_t{0};
  BoxOfWords<L> box;
  int outside = 0;
  for (int y = 0; y < grid.height; ++y)
    for (int w = 0; w * 64 < grid.width; ++w) {
      const std::uint8_t* first = grid.row(y) + static_cast<std::ptrdiff_t>(w) * WordCells<L>::kWordBytes;
      const Place place{first, first + grid.second_row};
      const bool is_inside = w * 64 + 64 <= grid.width && box.holdsAll(place);
      std::uint64_t& bits = words[w * stride + y];
      if (is_inside && refiner.isApart(box.box(), y, w)) {
        bits = kEvery;
        continue;
      }
      bits = refiner.classifyFull(y, w);
      if (is_inside || bits != kEvery || ++outside < kBeforeMove) continue;
      box.moveTo(place, colours.bounds());
      outside = 0;
    }
}

void classifyAll(const CellGrid& grid, const BackgroundCells* background, const CellRule& rule,
                 std::uint64_t* words, std::ptrdiff_t stride) {
  withRefiner(grid, background, rule, [&]<CellLayout L>(const auto& refiner) HWY_ATTR {
    if constexpr (L == CellLayout::kBytes) {
      for (int y = 0; y < grid.height; ++y)
        for (int w = 0; w * 64 < grid.width; ++w) words[w * stride + y] = refiner.classifyFull(y, w);
    } else {
      classifyRows<L>(refiner, grid, *rule.colours, words, stride);
    }
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

bool findCandidates(const CellGrid& grid, const BackgroundCells* background, const CellRule& rule,
                    const ScannedRows& rows, int first_word, int end_word, int most, CellWord* found,
                    int& count) {
  return HWY_DYNAMIC_DISPATCH(findInRows)(grid, background, rule, rows, first_word, end_word, most, found,
                                          count);
}

void refineCandidates(const CellGrid& grid, const BackgroundCells* background, const CellRule& rule,
                      std::span<CellWord> words) {
  HWY_DYNAMIC_DISPATCH(refineWords)(grid, background, rule, words.data(), words.size());
}

void classifyWords(const CellGrid& grid, const BackgroundCells* background, const CellRule& rule,
                   std::span<CellWord> words) {
  HWY_DYNAMIC_DISPATCH(classifySome)(grid, background, rule, words.data(), words.size());
}

void classifyGrid(const CellGrid& grid, const BackgroundCells* background, const CellRule& rule,
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
