#pragma once

namespace helical {

/// How a transmitter is, from what it last said; the defaults are those of one that is always well.
struct TransmitterStatus {
  bool present = true;
  bool self_test_passed = true;
  bool channels_calibrated = true;  ///< someone has measured which stick is where
  bool fault = false;               ///< the newest demand did not reach it
  bool pilot_flies = false;         ///< trainer switch: the pilot's own transmitter has the helicopter
  bool bench = false;               ///< the output is disabled: nothing but zero leaves
};

}  // namespace helical
