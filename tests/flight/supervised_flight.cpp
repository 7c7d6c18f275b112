#include "tests/flight/supervised_flight.h"

namespace helical::test {

SupervisorConditions randomConditions(Random& random, TimeNs now) {
  const auto rarely = [&random](double share) { return random.uniform() < share; };
  const auto mostly = [&](double mild, double wild) {
    return rarely(0.9) ? random.uniform(0.0, mild) : random.uniform(0.0, wild);
  };
  SupervisorConditions c;
  c.now = now;
  c.phase = static_cast<FlightPhase>(static_cast<int>(random.uniform(0.0, 7.0)));
  c.pose_known = !rarely(0.05);
  c.pose_age_s = rarely(0.6) ? random.uniform(0.0, 0.05) : random.uniform(0.0, 3.0);
  c.tilt = mostly(0.2, 3.0);
  c.speed = mostly(1.0, 6.0);
  c.drift = mostly(0.05, 1.0);
  c.place << mostly(0.3, 3.0), mostly(0.3, 3.0), random.uniform(-0.1, 2.05);
  c.standing_error = mostly(0.05, 1.0);
  c.flight_time_s = toSeconds(now);
  c.sticks_idle = !rarely(0.05);
  c.lift_off_failed = rarely(0.002);
  c.arm = rarely(0.3);
  c.disarm = rarely(0.02);
  c.kill = rarely(0.002);
  SystemHealth& h = c.health;
  h.live_cameras = rarely(0.9) ? 2 : static_cast<int>(random.uniform(0.0, 4.0));
  h.camera_silent = rarely(0.05);
  h.camera_clock_off = rarely(0.05);
  h.frame_share = rarely(0.9) ? 1.0 : random.uniform();
  h.tick_share = rarely(0.9) ? 1.0 : random.uniform();
  h.overrun_s = mostly(0.001, 0.05);
  h.position_sigma = mostly(0.01, 0.2);
  h.rotation_sigma = mostly(0.05, 1.0);
  h.residual_ratio = mostly(1.5, 6.0);
  h.yaw_ambiguous = rarely(0.05);
  h.transmitter_ready = !rarely(0.02);
  h.transmitter_fault = rarely(0.02);
  h.channels_calibrated = !rarely(0.02);
  h.pilot_flies = rarely(0.02);
  h.record_failed = rarely(0.02);
  h.record_stalled = rarely(0.02);
  h.cameras_disagree = rarely(0.02);
  h.disk_free_gb = rarely(0.95) ? 100.0 : random.uniform(0.0, 2.0);
  return c;
}

}  // namespace helical::test
