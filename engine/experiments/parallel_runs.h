#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace helical {

/// Does `work` for 0 .. runs - 1, each once, on as many threads as the machine has cores; `work` must bear
/// being called from several at a time. `progress`, on the calling thread, hears how many are done. Returns
/// when all are; what `work` throws ends the rest early and is thrown again here.
void forEachRun(int runs, const std::function<void(int)>& work, const std::function<void(int)>& progress);

/// What `once` gives for the seeds `first_seed`, `first_seed` + 1, ...: a run each.
template <class Once>
auto runSeeds(int runs, std::uint64_t first_seed, const std::function<void(int)>& progress, const Once& once) {
  std::vector<decltype(once(first_seed))> results(static_cast<std::size_t>(runs));
  forEachRun(
      runs,
      [&](int i) { results[static_cast<std::size_t>(i)] = once(first_seed + static_cast<std::uint64_t>(i)); },
      progress);
  return results;
}

}  // namespace helical
