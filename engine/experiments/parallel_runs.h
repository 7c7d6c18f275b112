#pragma once

#include <functional>

namespace helical {

/// Does `work` for 0 .. runs - 1, each once, on as many threads as the machine has cores; `work` must bear
/// being called from several at a time. `progress`, on the calling thread, hears how many are done. Returns
/// when all are; what `work` throws ends the rest early and is thrown again here.
void forEachRun(int runs, const std::function<void(int)>& work, const std::function<void(int)>& progress);

}  // namespace helical
