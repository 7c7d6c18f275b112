#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/markers/binary_mask.h"
#include "engine/markers/cell_kernels.h"
#include "engine/markers/mask_tile.h"
#include "engine/markers/region_labeller.h"

namespace helical {

/// Classification, opening, closing and labelling of an image, reading little of it.
///
/// An opening with a square of side k keeps full k x k squares only, and each of these crosses exactly one of
/// the rows k/2, k/2 + k, ...: only those rows are read; around runs of k cells in them, the k - 1 rows above
/// and below are, in the words that the run touches. What was found there is worked on in small rectangles
/// that cannot influence each other. Of windows, only what lies in them is read: regions that do not come
/// near a window's edge are those of the whole image. Where there is too much of it, all rows are classified
/// and the whole mask is worked on: slower for little, faster for much, equal in its result. Allocates in
/// `resize` only. One thread.
class RegionFinder {
 public:
  /// Sides of the squares; 1 switches a step off.
  RegionFinder(int opening, int closing) { setSides(opening, closing); }

  void setSides(int opening, int closing);
  void resize(int width, int height);

  /// Regions of the cells that `rule` takes and that `ignored`, if given, does not hold; in no particular
  /// order, valid until the next call. `windows`, which must not overlap, are read only; without any,
  /// everything. `mask`, if given, becomes the mask after opening and closing.
  std::span<Region> find(const CellGrid& frame, const BackgroundCells* background, const CellRule& rule,
                         const BinaryMask* ignored = nullptr, BinaryMask* mask = nullptr,
                         std::span<const WordRect> windows = {});

  /// Cells around a region that opening and closing decide about it by, and from which its parts may be seen.
  int border() const { return 2 * opening_reach_ + 2 * closing_reach_ + 2; }

 private:
  struct Task {
    const CellGrid& frame;
    const BackgroundCells* background;
    const CellRule& rule;
    const BinaryMask* ignored;
    BinaryMask* mask;
    std::span<const WordRect> windows;
  };

  bool findSparsely(const Task& task);
  void findDensely(const Task& task);
  bool scanRows(const Task& task, const WordRect& window);
  bool expandHits();
  bool expand(const CellWord& hit);
  bool addIsland(WordRect box);
  std::uint64_t runCentres(const CellWord& hit) const;
  void store(const Task& task, std::span<const CellWord> words);
  void copyMask(const Task& task) const;
  void forget();

  int opening_reach_ = 0;
  int closing_reach_ = 0;
  BinaryMask mask_;  ///< nothing set between calls
  MaskTile tile_;
  std::vector<CellWord> hits_;          ///< words of the rows that were read which hold candidates
  std::vector<CellWord> around_;        ///< words around them
  std::vector<std::uint8_t> is_known_;  ///< by word: in one of these lists; nothing set between calls
  std::size_t hit_count_ = 0;
  std::size_t around_count_ = 0;
  std::vector<WordRect> islands_;
  RegionLabeller labeller_;
};

}  // namespace helical
