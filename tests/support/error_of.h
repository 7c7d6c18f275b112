#pragma once

#include <gtest/gtest.h>

#include <functional>

#include "engine/base/error.h"

namespace helical {

/// The Error that `action` throws; the test fails when it throws none.
inline Error errorOf(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& error) {
    return error;
  }
  ADD_FAILURE() << "no Error was thrown";
  return Error(ErrorKind::kSystem, "");
}

}  // namespace helical
