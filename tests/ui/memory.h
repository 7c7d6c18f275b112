#pragma once

#include <malloc.h>

#include <algorithm>
#include <fstream>
#include <string>
#include <vector>

namespace helical {

/// What the process itself has taken, in MB: no mapped files, and nothing that was given back already.
inline double ownMemoryMb() {
  malloc_trim(0);
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;)
    if (word == "RssAnon:") {
      double kb = 0.0;
      status >> kb;
      return kb / 1024.0;
    }
  return 0.0;
}

/// Memory over several looks, in which pictures on their way to the screen come and go.
class MemoryLooks {
 public:
  /// Before anything large is made: large blocks are kept apart from the others, however often one was given
  /// back.
  static void keepLargeBlocksApart() { mallopt(M_MMAP_THRESHOLD, 256 << 10); }

  void look() {
    const struct mallinfo2 now = mallinfo2();
    large_.push_back(static_cast<double>(now.hblkhd) / (1 << 20));
    small_.push_back(static_cast<double>(now.uordblks) / (1 << 20));
    all_.push_back(ownMemoryMb());
  }

  /// What was allocated and not freed: exact to 0.1 MB, for of the blocks as large as pictures the least
  /// counts (one of 3 MB is under way in one look of four) and of the others the median.
  double allocatedMb() const { return ranked(large_, 0) + ranked(small_, small_.size() / 2); }

  /// With what the allocator keeps and the display's driver takes, the least: to one or two pictures.
  double allMb() const { return ranked(all_, 0); }

 private:
  static double ranked(std::vector<double> looks, std::size_t rank) {
    const auto nth = looks.begin() + static_cast<std::ptrdiff_t>(rank);
    std::nth_element(looks.begin(), nth, looks.end());
    return *nth;
  }

  std::vector<double> large_, small_, all_;
};

}  // namespace helical
