#include "engine/pipeline/calibration_order.h"

namespace helical {

const char* toString(CalibrationOrderKind kind) {
  switch (kind) {
    case CalibrationOrderKind::kFreeze:
      return "freeze";
    case CalibrationOrderKind::kResume:
      return "resume";
    case CalibrationOrderKind::kAccept:
      return "accept";
    case CalibrationOrderKind::kTrustRig:
      return "trust-rig";
    case CalibrationOrderKind::kAdopt:
      return "adopt";
    case CalibrationOrderKind::kRefine:
      return "refine";
  }
  return "";
}

}  // namespace helical
