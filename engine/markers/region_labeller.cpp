#include "engine/markers/region_labeller.h"

#include <algorithm>
#include <bit>
#include <utility>

namespace helical {

void RegionLabeller::resize(int width, int height) {
  const auto w = static_cast<std::size_t>(width), h = static_cast<std::size_t>(height);
  above_.reserve(w / 2 + 1);
  current_.reserve(w / 2 + 1);
  // A 2x2 square of pixels can hold the first pixel of one new region only.
  const std::size_t most = ((w + 1) / 2) * ((h + 1) / 2);
  parents_.reserve(most);
  regions_.reserve(most);
}

void RegionLabeller::clear() {
  parents_.clear();
  regions_.clear();
}

void RegionLabeller::label(const MaskTile& part, std::span<const std::uint64_t> changes) {
  current_.clear();
  const int top = part.rect().top, end = part.rect().bottom + 1;
  const auto isLikeAbove = [&](int y) { return changes[static_cast<std::size_t>(y - top)] == 0; };
  for (int y = top; y < end;) {
    int next = y;
    while (y > top && !changes.empty() && next < end && isLikeAbove(next)) ++next;
    if (next > y) {
      repeatRuns(y, next - y);
      y = next;
      continue;
    }
    std::swap(above_, current_);
    findRuns(part, y);
    joinRuns(y);
    ++y;
  }
}

std::span<Region> RegionLabeller::regions() {
  std::size_t count = 0;
  for (std::size_t i = 0; i < parents_.size(); ++i)
    if (parents_[i] == static_cast<int>(i)) regions_[count++] = regions_[i];
  parents_.clear();
  return {regions_.data(), count};
}

void RegionLabeller::findRuns(const MaskTile& part, int y) {
  current_.clear();
  const std::uint64_t* word = part.column(part.rect().left) + (y - part.rect().top);
  for (int w = part.rect().left; w <= part.rect().right; ++w, word += part.stride()) {
    std::uint64_t rest = *word;
    if (rest == ~std::uint64_t{0} && !current_.empty() && current_.back().last == 64 * w - 1) {
      current_.back().last += 64;
      continue;
    }
    while (rest != 0) {
      const int start = std::countr_zero(rest);
      const int length = std::countr_one(rest >> start);
      const int first = 64 * w + start;
      if (!current_.empty() && current_.back().last == first - 1)
        current_.back().last = first + length - 1;
      else
        current_.push_back({first, first + length - 1, -1});
      rest = start + length >= 64 ? 0 : rest & (~std::uint64_t{0} << (start + length));
    }
  }
}

void RegionLabeller::joinRuns(int y) {
  auto neighbour = above_.cbegin();
  for (Run& run : current_) {
    while (neighbour != above_.cend() && neighbour->last < run.first - 1) ++neighbour;
    for (auto other = neighbour; other != above_.cend() && other->first <= run.last + 1; ++other)
      run.label = run.label < 0 ? rootOf(other->label) : unite(run.label, rootOf(other->label));
    if (run.label < 0) {
      run.label = static_cast<int>(parents_.size());
      parents_.push_back(run.label);
      regions_.push_back({0, 0, 0, run.first, y, run.last, y});
    }
    Region& region = regions_[static_cast<std::size_t>(run.label)];
    const std::int64_t length = run.last - run.first + 1;
    region.area += length;
    region.sum_x += length * (run.first + run.last) / 2;
    region.sum_y += length * y;
    region.left = std::min(region.left, run.first);
    region.right = std::max(region.right, run.last);
    region.bottom = y;
  }
}

/// The runs of the last row once more in each of the next `rows`.
void RegionLabeller::repeatRuns(int y, int rows) {
  for (const Run& run : current_) {
    Region& region = regions_[static_cast<std::size_t>(rootOf(run.label))];
    const std::int64_t length = run.last - run.first + 1;
    region.area += rows * length;
    region.sum_x += rows * (length * (run.first + run.last) / 2);
    region.sum_y += length * (static_cast<std::int64_t>(rows) * (2 * y + rows - 1) / 2);
    region.bottom = y + rows - 1;
  }
}

int RegionLabeller::rootOf(int label) {
  auto i = static_cast<std::size_t>(label);
  while (parents_[i] != static_cast<int>(i)) {
    parents_[i] = parents_[static_cast<std::size_t>(parents_[i])];
    i = static_cast<std::size_t>(parents_[i]);
  }
  return static_cast<int>(i);
}

int RegionLabeller::unite(int a, int b) {
  if (a == b) return a;
  const auto [kept, gone] = std::minmax(a, b);
  Region& into = regions_[static_cast<std::size_t>(kept)];
  const Region& from = regions_[static_cast<std::size_t>(gone)];
  into.area += from.area;
  into.sum_x += from.sum_x;
  into.sum_y += from.sum_y;
  into.left = std::min(into.left, from.left);
  into.top = std::min(into.top, from.top);
  into.right = std::max(into.right, from.right);
  into.bottom = std::max(into.bottom, from.bottom);
  parents_[static_cast<std::size_t>(gone)] = kept;
  return kept;
}

}  // namespace helical
