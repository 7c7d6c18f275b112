#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "engine/markers/background_ranges.h"
#include "engine/markers/cell_grid.h"
#include "engine/markers/colour_class.h"

namespace helical {

/// 64 cells of a row: bit i stands for cell 64 word + i.
struct CellWord {
  std::int32_t row = 0;
  std::int32_t word = 0;
  std::uint64_t bits = 0;
};

/// What makes a cell a marker's. `colours` is for three-channel grids in its order, the range for brightness
/// alone.
struct CellRule {
  const ColourClass* colours = nullptr;
  std::uint8_t brightness_low = 0;
  std::uint8_t brightness_high = 255;
  std::uint8_t background_threshold = 0;
};

/// The loops over pixels, in the instructions of the machine they run on (Google Highway; one binary has
/// all). Every instruction set gives the same bits.

/// Every `step`-th row from `first` on, and `last` at the end, as far as `end`.
struct ScannedRows {
  int first = 0;
  int step = 1;
  int last = 0;
  int end = 0;

  int after(int y) const { return y + step < last ? y + step : last; }
};

/// The cells of these rows in words [first_word, end_word) that may be a marker's by themselves: a superset
/// for colours, exact for brightness. Writes the words whose cells may be part of `rows.step` in a row to
/// `found` and their number to `count`. False: stopped after a row with which they became more than `most`,
/// or so many of few words that they will be more; `found` has room for that row, too. The next rows, and
/// frame and background around what is found, are fetched into the cache on the way.
bool findCandidates(const CellGrid& grid, const BackgroundCells* background, const CellRule& rule,
                    const ScannedRows& rows, int first_word, int end_word, int most, CellWord* found,
                    int& count);

/// Replaces candidate bits by exact ones: cells that the rule takes and that differ from the background, if
/// there is one, by more than the threshold.
void refineCandidates(const CellGrid& grid, const BackgroundCells* background, const CellRule& rule,
                      std::span<CellWord> words);

/// The same without candidates, for words of which nothing is known.
void classifyWords(const CellGrid& grid, const BackgroundCells* background, const CellRule& rule,
                   std::span<CellWord> words);

/// Exact bits of the whole grid: each word's next row behind it, its next word `stride` on.
void classifyGrid(const CellGrid& grid, const BackgroundCells* background, const CellRule& rule,
                  std::uint64_t* words, std::ptrdiff_t stride);

/// The instruction set in use, and those that this machine has, best first, as Highway names them.
std::string instructionSet();
std::vector<std::string> instructionSets();
/// For tests and benchmarks: use this one from now on; an empty name: the best again. While nothing else
/// runs.
void useInstructionSet(const std::string& name);

}  // namespace helical
