#include "engine/calibration/rig/swapped_columns.h"

#include "engine/base/error.h"
#include "engine/calibration/rig/point_rows.h"

namespace helical {
namespace {

constexpr long kFewRows = 10;

bool fits(double u, double v, const CameraModel& camera) {
  return u > -1.0 && v > -1.0 && u < camera.width() && v < camera.height();
}

}  // namespace

SwappedColumns::SwappedColumns(std::span<const RigCamera> cameras)
    : cameras_(cameras), watches_(cameras.size()) {}

void SwappedColumns::add(const PointRow& row) {
  Watch& w = watches_[static_cast<std::size_t>(row.camera)];
  const CameraModel& camera = cameras_[static_cast<std::size_t>(row.camera)].model;
  const double u = row.pixel.x(), v = row.pixel.y();
  const bool as_is = fits(u, v, camera), swapped = fits(v, u, camera);
  w.outside += as_is ? 0 : 1;
  w.beyond_height += !as_is && swapped ? 1 : 0;
  w.beyond_swapped += as_is && !swapped ? 1 : 0;
  if (w.rows > 0) {
    w.time_falls += row.time_s < w.time_s ? 1 : 0;
    w.u_falls += u < w.u ? 1 : 0;
    w.v_falls += v < w.v ? 1 : 0;
  }
  w.time_s = row.time_s, w.u = u, w.v = v;
  ++w.rows;
}

void SwappedColumns::check(const std::string& file) const {
  for (std::size_t i = 0; i < watches_.size(); ++i) {
    const Watch& w = watches_[i];
    const std::string camera = "camera " + cameras_[i].label;
    const std::string size =
        std::to_string(cameras_[i].model.width()) + "x" + std::to_string(cameras_[i].model.height());
    if (w.beyond_height > kFewRows && w.beyond_height > 10 * w.beyond_swapped)
      throw Error(ErrorKind::kInput,
                  "u_px and v_px look swapped: " + std::to_string(w.beyond_height) + " rows of " + camera +
                      " lie outside its " + size + " pixels and inside the other way round",
                  file, "correct the header");
    if (w.time_falls > w.rows / 20 && w.rows > kFewRows)
      for (const auto& [falls, name] : {std::pair(w.u_falls, "u_px"), std::pair(w.v_falls, "v_px")})
        if (falls * 100 <= w.rows)
          throw Error(ErrorKind::kInput,
                      std::string("time_s and ") + name + " look swapped: in the rows of " + camera + " " +
                          name + " never falls and time_s goes up and down",
                      file, "correct the header");
    if (w.outside * 2 > w.rows)
      throw Error(ErrorKind::kInput,
                  std::to_string(w.outside) + " of " + std::to_string(w.rows) + " rows of " + camera +
                      " lie outside its " + size + " pixels",
                  file,
                  "see that the rig file gives the size of the recorded images, and the header the columns");
  }
}

}  // namespace helical
