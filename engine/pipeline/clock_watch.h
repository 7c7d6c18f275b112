#pragma once

#include <cstdint>

#include "engine/markers/observation.h"

namespace helical {

/// Whether one camera's stamps can be believed, from the time that its frames take from exposure to arrival:
/// that moves when frames come late, and when its clock jumps. Which of the two it was shows in the frame in
/// which it moved: were it the stamps, they break their rhythm, else the arrivals do. Late frames tell the
/// truth about another time; frames of a clock that jumped put the helicopter where it was not. One thread;
/// allocates nothing.
class ClockWatch {
 public:
  void add(const Observation& observation);

  /// The newest frame took longer or shorter than usual by more than half a frame.
  bool isOff() const { return off_; }
  /// And its stamp is wrong. Over with the first frame whose stamp is right again.
  bool hasJumped() const { return off_ && jumped_; }

 private:
  void learn(const Observation& observation, double latency);
  bool stampsBrokeTheirRhythm(const Observation& observation) const;

  int known_ = 0;               ///< frames that it learnt from, up to enough
  std::uint64_t first_sequence_ = 0;
  TimeNs first_exposure_ = 0;
  double period_s_ = 0.0;       ///< of the frames
  double usual_latency_s_ = 0.0;
  std::uint64_t last_sequence_ = 0;
  TimeNs last_exposure_ = 0, last_arrival_ = 0;
  double last_latency_s_ = 0.0;
  bool off_ = false;
  bool jumped_ = false;
  TimeNs late_since_ = 0;       ///< by arrival
};

}  // namespace helical
