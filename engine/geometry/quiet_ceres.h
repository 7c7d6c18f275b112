#pragma once

namespace helical {

/// Keeps Ceres' warnings (steps that it takes back and tries shorter) from stderr, where they would stand
/// among Helical's own messages without saying anything to users. Errors still get there. Any thread, any
/// number of times.
void quietCeres();

}  // namespace helical
