#pragma once

#include <deque>
#include <memory>
#include <span>
#include <vector>

#include "engine/base/clock.h"
#include "engine/base/random.h"
#include "engine/experiments/fault_plan.h"
#include "engine/markers/observation.h"
#include "engine/transmitter/transmitter.h"

namespace helical {

/// The faults of one kind that act at a time, for those who bear them.
bool actsNow(const Fault& fault, double time_s);

/// A camera whose frames suffer what a plan of faults has for it. One thread.
class FaultySource final : public ObservationSource {
 public:
  FaultySource(std::unique_ptr<ObservationSource> source, std::vector<Fault> faults, std::shared_ptr<Clock> clock,
               int width, int height, std::uint64_t seed);

  CameraId camera() const override { return source_->camera(); }
  bool poll(Observation& observation) override;
  void wait(TimeNs deadline) override { source_->wait(deadline); }

 private:
  struct Waiting {
    TimeNs due;
    Observation observation;
  };
  /// False: it never arrives. Adds to `late`.
  bool suffer(Observation& observation, TimeNs& late);
  void suffer(const Fault& fault, Observation& observation);
  void addFalse(double count, Observation& observation);

  std::unique_ptr<ObservationSource> source_;
  std::vector<Fault> faults_;
  std::shared_ptr<Clock> clock_;
  int width_, height_;
  Random random_;
  std::deque<Waiting> waiting_;
};

/// A transmitter that suffers likewise. Unplugged, its outputs are at 0; what is plugged in again takes what it is told.
class FaultyTransmitter final : public Transmitter {
 public:
  FaultyTransmitter(std::unique_ptr<Transmitter> transmitter, std::vector<Fault> faults);

  void send(const StickDemand& demand, TimeNs now) override;
  TransmitterStatus status() const override { return status_; }
  /// What the helicopter is told.
  const StickDemand& delivered() const { return delivered_; }

 private:
  std::unique_ptr<Transmitter> transmitter_;
  std::vector<Fault> faults_;
  TransmitterStatus status_;
  StickDemand delivered_;
};

}  // namespace helical
