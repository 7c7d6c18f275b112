#pragma once

#include <malloc.h>

#include <fstream>
#include <string>

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

}  // namespace helical
