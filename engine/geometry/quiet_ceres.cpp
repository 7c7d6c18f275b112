#include "engine/geometry/quiet_ceres.h"

#include <ceres/ceres.h>

#include <mutex>

// Ceres logs through glog, unless it was built with its own stand-in, which writes errors only.
#if __has_include(<glog/logging.h>)
#include <glog/logging.h>
#endif

namespace helical {

void quietCeres() {
#if __has_include(<glog/logging.h>)
  static std::once_flag once;
  std::call_once(once, [] { FLAGS_minloglevel = google::GLOG_ERROR; });
#endif
}

}  // namespace helical
