#include "engine/base/error.h"

#include <utility>

namespace helical {
namespace {

std::string message(const std::string& what, const std::string& where, const std::string& cure) {
  std::string text = where.empty() ? what : where + ": " + what;
  if (!cure.empty()) text += "\n  cure: " + cure;
  return text;
}

}  // namespace

Error::Error(ErrorKind kind, std::string what, std::string where, std::string cure)
    : std::runtime_error(message(what, where, cure)),
      kind_(kind),
      problem_(std::move(what)),
      where_(std::move(where)),
      cure_(std::move(cure)) {}

}  // namespace helical
