#include "app/centroid_csv.h"

#include <cerrno>
#include <cmath>
#include <cstring>
#include <string>

#include "engine/base/error.h"

namespace helical {
namespace {

std::string cureFor(int error) {
  switch (error) {
    case ENOSPC:
    case EDQUOT:
      return "free some space, or choose another disk";
    case EACCES:
    case EPERM:
    case EROFS:
      return "choose a folder that you may write to";
    case ENOENT:
    case ENOTDIR:
      return "create its folder first";
    case EISDIR:
      return "give the name of a file, not of a folder";
    default:
      return "choose another place for it";
  }
}

bool isUsersMistake(int error) {
  return error == ENOENT || error == ENOTDIR || error == EISDIR;
}

}  // namespace

CentroidCsv::CentroidCsv(const std::filesystem::path& file)
    : path_(file), file_(std::fopen(file.c_str(), "w")) {
  if (!file_) {
    const int error = errno;
    throw Error(isUsersMistake(error) ? ErrorKind::kInput : ErrorKind::kSystem,
                std::string("cannot be written: ") + std::strerror(error), file.string(), cureFor(error));
  }
  check(std::fputs("frame,time_s,marker,u_px,v_px,radius_px,area_px,sigma_px\n", file_.get()) >= 0);
}

void CentroidCsv::add(int frame, std::optional<double> time_s, const Observation& observation) {
  const std::string time = time_s ? std::to_string(*time_s) : std::string();
  for (int i = 0; i < observation.count; ++i) {
    const Centroid& c = observation.centroids[static_cast<std::size_t>(i)];
    check(std::fprintf(file_.get(), "%d,%s,%d,%.4f,%.4f,%.3f,%.0f,%.4f\n", frame, time.c_str(), i,
                       c.pixel.x(), c.pixel.y(), c.radius_px, c.area_px,
                       std::sqrt(0.5 * c.covariance.trace())) >= 0);
  }
}

void CentroidCsv::finish() {
  check(std::fflush(file_.get()) == 0);
}

void CentroidCsv::check(bool written) const {
  if (written) return;
  const int error = errno;
  throw Error(ErrorKind::kSystem, std::string("writing failed: ") + std::strerror(error), path_.string(),
              cureFor(error));
}

}  // namespace helical
