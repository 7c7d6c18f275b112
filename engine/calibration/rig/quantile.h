#pragma once

#include <algorithm>
#include <vector>

namespace helical {

/// The value that this fraction of all stays below, 0.5 for the (upper) median; 0 of none. Reorders them.
inline double quantileOf(std::vector<double>& values, double fraction) {
  if (values.empty()) return 0.0;
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(fraction * static_cast<double>(values.size()));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

}  // namespace helical
