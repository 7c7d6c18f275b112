#pragma once

#include <string>

namespace helical {

/// The unit of a field, "m/s", as its name or its message says; empty for numbers without and for texts.
/// `path` is "twist.linear.x"; `index` counts in an array. ROS 2 has SI units and radians.
std::string unitOf(const std::string& message, const std::string& path, int index);

}  // namespace helical
