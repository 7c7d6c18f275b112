#pragma once

#include <string_view>

namespace helical::gige {

/// What the virtual camera offers, in GenICam's words: every client reads it from the device. Addresses are those of
/// registers.h.
std::string_view deviceDescription();

}  // namespace helical::gige
