#pragma once

#include <span>
#include <string>
#include <vector>

#include "engine/calibration/rig/rig_camera.h"

namespace helical {

struct PointRow;

/// Watches rows go by for the signs of columns with each other's names. A mirrored recording can be solved
/// almost as well as a true one, so that residuals alone would not tell.
class SwappedColumns {
 public:
  explicit SwappedColumns(std::span<const RigCamera> cameras);

  void add(const PointRow& row);

  /// Throws Error(kInput) if columns look swapped, or half of the rows lie outside their images.
  void check(const std::string& file) const;

 private:
  struct Watch {
    long rows = 0, outside = 0;
    long beyond_height = 0;   ///< v beyond the image's height while u and v would fit the other way round
    long beyond_swapped = 0;  ///< rows that fit as they are and would not fit the other way round
    long time_falls = 0, u_falls = 0, v_falls = 0;
    double time_s = 0.0, u = 0.0, v = 0.0;
  };
  std::span<const RigCamera> cameras_;
  std::vector<Watch> watches_;
};

}  // namespace helical
