#include "engine/transmitter/transmitter_status.h"

namespace helical {

const char* toString(TransmitterTrouble trouble) {
  switch (trouble) {
    case TransmitterTrouble::kNone:
      return "";
    case TransmitterTrouble::kAbsent:
      return "the transmitter's device is not plugged in";
    case TransmitterTrouble::kSeveral:
      return "several such devices are plugged in";
    case TransmitterTrouble::kNoPermission:
      return "no permission to use the transmitter's device";
    case TransmitterTrouble::kBusy:
      return "another program has the transmitter's device";
    case TransmitterTrouble::kSelfTestFailed:
      return "the transmitter's device fails its self-test";
    case TransmitterTrouble::kUnfit:
      return "the transmitter's device does not have the outputs that the rig names";
    case TransmitterTrouble::kStalled:
      return "the transmitter's device refused a demand";
    case TransmitterTrouble::kTimedOut:
      return "the transmitter's device does not answer";
    case TransmitterTrouble::kNotAcknowledged:
      return "the helicopter does not acknowledge";
    case TransmitterTrouble::kFailed:
      return "the transmitter's device failed";
  }
  return "";
}

const char* cureOf(TransmitterTrouble trouble) {
  switch (trouble) {
    case TransmitterTrouble::kNone:
      return "";
    case TransmitterTrouble::kAbsent:
      return "plug it in; `helical devices` lists what is there";
    case TransmitterTrouble::kSeveral:
      return "give the rig's transmitter the serial number of one: device = \"...\"; `helical devices` lists them";
    case TransmitterTrouble::kNoPermission:
      return "install the udev rules: `helical doctor` says how";
    case TransmitterTrouble::kBusy:
      return "end the other program";
    case TransmitterTrouble::kUnfit:
      return "correct the outputs in [[transmitter.channel]], or plug in another device";
    case TransmitterTrouble::kNotAcknowledged:
      return "switch the helicopter on; check channel, rate and address in [transmitter.radio]";
    case TransmitterTrouble::kSelfTestFailed:
    case TransmitterTrouble::kStalled:
    case TransmitterTrouble::kTimedOut:
    case TransmitterTrouble::kFailed:
      return "plug it in anew, at another port or cable";
  }
  return "";
}

}  // namespace helical
