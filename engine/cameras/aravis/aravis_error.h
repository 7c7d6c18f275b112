#pragma once

#include <string>

struct _GError;

namespace helical {

/// Takes the errors of Aravis' calls one after the other: `arv_...(..., slot)`, then ask. One thread.
class AravisError {
 public:
  AravisError() = default;
  ~AravisError();
  AravisError(const AravisError&) = delete;
  AravisError& operator=(const AravisError&) = delete;

  /// Where the next call puts its error; forgets the last one.
  _GError** slot();
  explicit operator bool() const { return error_ != nullptr; }
  std::string text() const;
  /// Throws Error(kDevice) if there is one: `what` could not be done with the camera at `where`.
  void check(const std::string& what, const std::string& where) const;

 private:
  _GError* error_ = nullptr;
};

}  // namespace helical
