#pragma once

namespace helical {

/// How urgent the calling thread is, beside everything else on the machine.
enum class Urgency {
  kControl,  ///< what steers: some hundred microseconds now and then
  kCapture,  ///< what brings images, behind what steers: not for more work than the machine has time
};

/// Runs the calling thread before all ordinary ones, in real time; niceness does not reach beyond a terminal's programs.
/// Where this user may not, nothing changes and the answer is false: `helical doctor` names the cure. Threads that it
/// starts are ordinary again. Any thread.
bool raisePriority(Urgency urgency);

}  // namespace helical
