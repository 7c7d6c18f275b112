#include "engine/pipeline/output_loop.h"

namespace helical {

void OutputLoop::submit(const StickDemand& demand, TimeNs now) {
  newest_.back() = {demand, now};
  newest_.publish();
}

void OutputLoop::send(const StickDemand& demand, TimeNs now) {
  transmitter_.send(demand, now);
  status_.back() = transmitter_.status();
  status_.publish();
}

void OutputLoop::step(TimeNs now) {
  if (stopped()) {
    send({}, now);
    return;
  }
  newest_.take();
  const StickDemand demand = guard_.step(newest_.front().demand, newest_.front().time, now);
  // Rotors that were spun down stay off, whatever the flight thread says when it wakes up.
  if (guard_.locked()) gave_up_.store(true, std::memory_order_release);
  send(demand, now);
}

}  // namespace helical
