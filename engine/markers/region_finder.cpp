#include "engine/markers/region_finder.h"

#include <algorithm>

namespace helical {
namespace {

constexpr std::size_t kMostIslands = 48;
/// Sparse work stops being worth it when it comes to this share of the words it may come to.
constexpr int kDenseShare = 4;

}  // namespace

void RegionFinder::setSides(int opening, int closing) {
  opening_reach_ = opening / 2;
  closing_reach_ = closing / 2;
}

void RegionFinder::resize(int width, int height) {
  mask_.resize(width, height);
  tile_.resize(width, height);
  const auto words = static_cast<std::size_t>(mask_.wordsPerRow()) * static_cast<std::size_t>(height);
  hits_.resize(words);
  around_.resize(words);
  is_known_.assign(words, 0);
  islands_.reserve(kMostIslands);
  labeller_.resize(width, height);
}

std::span<Region> RegionFinder::find(const CellGrid& frame, const BackgroundCells* background,
                                     const CellRule& rule, const BinaryMask* ignored, BinaryMask* mask,
                                     std::span<const WordRect> windows) {
  const WordRect everywhere = mask_.everywhere();
  const Task task{frame,   background, rule,
                  ignored, mask,       windows.empty() ? std::span(&everywhere, 1) : windows};
  labeller_.clear();
  if (mask != nullptr) mask->clear(mask->everywhere());
  const bool done = findSparsely(task);
  forget();
  if (!done) findDensely(task);
  return labeller_.regions();
}

bool RegionFinder::findSparsely(const Task& task) {
  if (!std::all_of(task.windows.begin(), task.windows.end(),
                   [&](const WordRect& window) { return scanRows(task, window); }))
    return false;
  if (hit_count_ == 0) return true;
  const std::span hits(hits_.data(), hit_count_);
  refineCandidates(task.frame, task.background, task.rule, hits);
  store(task, hits);
  if (!expandHits()) return false;
  const std::span around(around_.data(), around_count_);
  classifyWords(task.frame, task.background, task.rule, around);
  store(task, around);
  for (const WordRect& island : islands_) {
    tile_.place(mask_.clip(island.grown(closing_reach_, 1)));
    const WordRect& rect = tile_.rect();
    for (int w = rect.left; w <= rect.right; ++w)
      for (int y = rect.top; y <= rect.bottom; ++y) tile_.column(w)[y - rect.top] = mask_.row(y)[w];
    tile_.open(opening_reach_);
    tile_.close(closing_reach_);
    labeller_.label(tile_);
    copyMask(task);
  }
  return true;
}

bool RegionFinder::scanRows(const Task& task, const WordRect& window) {
  const int words = mask_.wordsPerRow(), height = mask_.height(), step = 2 * opening_reach_ + 1;
  const int last = std::max(0, height - 1 - opening_reach_);
  const int most = words * (height / step + 1) / kDenseShare - static_cast<int>(hit_count_);
  ScannedRows rows{std::min(opening_reach_, last), step, last, window.bottom};
  if (rows.first < window.top)
    rows.first = std::min(last, rows.first + (window.top - rows.first + step - 1) / step * step);
  int found = 0;
  const bool is_sparse = findCandidates(task.frame, task.background, task.rule, rows, window.left,
                                        window.right + 1, most, hits_.data() + hit_count_, found);
  hit_count_ += static_cast<std::size_t>(found);
  return is_sparse;
}

void RegionFinder::store(const Task& task, std::span<const CellWord> words) {
  for (const CellWord& word : words)
    mask_.row(word.row)[word.word] =
        task.ignored == nullptr ? word.bits : word.bits & ~task.ignored->row(word.row)[word.word];
}

bool RegionFinder::expandHits() {
  const auto words = static_cast<std::ptrdiff_t>(mask_.wordsPerRow());
  for (const CellWord& hit : std::span(hits_.data(), hit_count_))
    is_known_[static_cast<std::size_t>(hit.row * words + hit.word)] = 1;
  return std::all_of(hits_.begin(), hits_.begin() + static_cast<std::ptrdiff_t>(hit_count_),
                     [this](const CellWord& hit) { return expand(hit); });
}

std::uint64_t RegionFinder::runCentres(const CellWord& hit) const {
  const std::uint64_t* row = mask_.row(hit.row);
  const int w = hit.word, last = mask_.wordsPerRow() - 1;
  constexpr std::uint64_t kAll = ~std::uint64_t{0};
  const int used = w == last && mask_.width() % 64 != 0 ? mask_.width() % 64 : 64;
  const std::uint64_t beyond = used == 64 ? 0 : kAll << used;
  const std::uint64_t here = row[w] | beyond;
  const std::uint64_t before = w == 0 ? kAll : row[w - 1];
  std::uint64_t after = w == last ? kAll : row[w + 1];
  if (w + 1 == last && mask_.width() % 64 != 0) after |= kAll << mask_.width() % 64;
  std::uint64_t centres = here & ~beyond;
  for (int s = 1; s <= opening_reach_; ++s)
    centres &= (here << s | before >> (64 - s)) & (here >> s | after << (64 - s));
  return centres;
}

bool RegionFinder::expand(const CellWord& hit) {
  if (mask_.row(hit.row)[hit.word] == 0) return true;
  const std::uint64_t centres = runCentres(hit);
  if (centres == 0) return true;
  const int words = mask_.wordsPerRow();
  const bool reaches_left = opening_reach_ > 0 && centres << (64 - opening_reach_) != 0;
  const bool reaches_right = opening_reach_ > 0 && centres >> (64 - opening_reach_) != 0;
  const WordRect box = mask_.clip({hit.row - 2 * opening_reach_, hit.row + 2 * opening_reach_,
                                   hit.word - (reaches_left ? 1 : 0), hit.word + (reaches_right ? 1 : 0)});
  for (int y = box.top; y <= box.bottom; ++y)
    for (int w = box.left; w <= box.right; ++w) {
      std::uint8_t& known = is_known_[static_cast<std::size_t>(y) * static_cast<std::size_t>(words) +
                                      static_cast<std::size_t>(w)];
      if (known != 0) continue;
      known = 1;
      around_[around_count_++] = {y, w, 0};
    }
  return around_count_ <= is_known_.size() / static_cast<std::size_t>(kDenseShare) && addIsland(box);
}

bool RegionFinder::addIsland(WordRect box) {
  for (std::size_t i = 0; i < islands_.size();) {
    // Nearer ones could be joined by the closing, or would share words with it.
    if (!box.grown(2 * closing_reach_ + 1, 2).overlaps(islands_[i])) {
      ++i;
      continue;
    }
    box.include(islands_[i]);
    islands_[i] = islands_.back();
    islands_.pop_back();
    i = 0;
  }
  if (islands_.size() == kMostIslands) return false;
  islands_.push_back(box);
  return true;
}

void RegionFinder::copyMask(const Task& task) const {
  if (task.mask == nullptr) return;
  const WordRect& rect = tile_.rect();
  for (int y = rect.top; y <= rect.bottom; ++y)
    for (int w = rect.left; w <= rect.right; ++w) task.mask->row(y)[w] = tile_.column(w)[y - rect.top];
}

void RegionFinder::forget() {
  const auto words = static_cast<std::size_t>(mask_.wordsPerRow());
  const auto forgetAll = [&](std::span<const CellWord> list) {
    for (const CellWord& word : list) {
      mask_.row(word.row)[word.word] = 0;
      is_known_[static_cast<std::size_t>(word.row) * words + static_cast<std::size_t>(word.word)] = 0;
    }
  };
  forgetAll({hits_.data(), hit_count_});
  forgetAll({around_.data(), around_count_});
  hit_count_ = around_count_ = 0;
  islands_.clear();
}

void RegionFinder::findDensely(const Task& task) {
  labeller_.clear();
  tile_.place(mask_.everywhere());
  classifyGrid(task.frame, task.background, task.rule, tile_.column(0), tile_.stride());
  if (task.ignored != nullptr)
    for (int w = 0; w < mask_.wordsPerRow(); ++w)
      for (int y = 0; y < mask_.height(); ++y) tile_.column(w)[y] &= ~task.ignored->row(y)[w];
  tile_.openAndCloseFull(opening_reach_, closing_reach_);
  labeller_.label(tile_, tile_.changes());
  copyMask(task);
}

}  // namespace helical
