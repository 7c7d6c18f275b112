#pragma once

#include <cstdint>

namespace helical {

/// What is wrong with a transmitter's device.
enum class TransmitterTrouble : std::uint8_t {
  kNone,
  kAbsent,           ///< it is not plugged in
  kSeveral,          ///< several are, and nobody says which one
  kNoPermission,     ///< this user may not open it
  kBusy,             ///< another program has it
  kSelfTestFailed,   ///< its calibration or its state cannot be read
  kUnfit,            ///< it does not have the outputs that are asked for
  kStalled,          ///< it refused what it was told
  kTimedOut,         ///< it does not answer
  kNotAcknowledged,  ///< the helicopter does not answer its radio
  kFailed,           ///< the bus failed
};

/// How a transmitter is, from what it last said; the defaults are those of one that is always well.
struct TransmitterStatus {
  bool present = true;
  bool self_test_passed = true;
  bool channels_calibrated = true;  ///< someone has measured which stick is where, and seen which way it goes
  bool fault = false;               ///< the newest demand did not reach it
  bool pilot_flies = false;         ///< trainer switch: the pilot's own transmitter has the helicopter
  bool bench = false;               ///< the output is disabled: nothing but zero leaves
  TransmitterTrouble trouble = TransmitterTrouble::kNone;
};

/// For the operator: what is wrong, and the cure; both empty for kNone.
const char* toString(TransmitterTrouble trouble);
const char* cureOf(TransmitterTrouble trouble);

}  // namespace helical
