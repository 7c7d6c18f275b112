#pragma once

namespace helical {

/// How far off balls (per axis) and focal lengths (as a share) may be said, or drawn, to be: beyond, the rig file
/// is simply wrong.
constexpr double kMostMarkerSigmaM = 0.02;
constexpr double kMostFocalSigma = 0.1;

}  // namespace helical
