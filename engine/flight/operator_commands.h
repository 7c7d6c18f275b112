#pragma once

namespace helical {

/// What the operator asked for since the last tick.
struct OperatorCommands {
  bool arm = false;       ///< the rotors may turn; refused unless every pre-arm check passes
  bool disarm = false;    ///< with the rotors off
  bool take_off = false;  ///< of an armed helicopter on the pad; in the air: the plan goes on after a hold
  bool hold = false;      ///< stays where it is until told otherwise
  bool land = false;
  bool kill = false;
};

}  // namespace helical
