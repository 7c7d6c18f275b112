#include "engine/cameras/aravis/aravis_error.h"

#include <arv.h>

#include "engine/base/error.h"

namespace helical {

AravisError::~AravisError() {
  g_clear_error(&error_);
}

_GError** AravisError::slot() {
  g_clear_error(&error_);
  return &error_;
}

std::string AravisError::text() const {
  return error_ != nullptr ? error_->message : "";
}

void AravisError::check(const std::string& what, const std::string& where) const {
  if (error_ != nullptr)
    throw Error(ErrorKind::kDevice, what + " failed: " + text(), where, "check its cable and power, then try again");
}

}  // namespace helical
