#pragma once

#include <string>

#include "tests/support/error_of.h"

namespace helical {

/// A small good rig of one recorded camera, "left", and room for more.
std::string goodRig();

/// `text` with the first `from` replaced; the test fails when there is none.
std::string replaced(std::string text, const std::string& from, const std::string& to);

/// The number of the line in which `word` first stands, counted from 1.
int lineOf(const std::string& text, const std::string& word);

}  // namespace helical
