#include "engine/base/thread_priority.h"

#include <sched.h>

namespace helical {
namespace {

constexpr int kControlPriority = 10, kCapturePriority = 5;  // above ordinary threads, below the machine's own

}  // namespace

bool raisePriority(Urgency urgency) {
  sched_param parameters{};
  parameters.sched_priority = urgency == Urgency::kControl ? kControlPriority : kCapturePriority;
  return sched_setscheduler(0, SCHED_RR | SCHED_RESET_ON_FORK, &parameters) == 0;
}

}  // namespace helical
