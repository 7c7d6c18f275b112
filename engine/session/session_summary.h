#pragma once

#include <string>
#include <vector>

#include "engine/pipeline/flight_score.h"
#include "engine/session/export_selection.h"
#include "engine/session/mcap_reader.h"
#include "engine/session/session_settings.h"

namespace helical {

/// A recorded flight at one control tick, for figures. What is not known is NaN.
struct SessionSample {
  struct Camera {
    Eigen::Vector3d position_error = Eigen::Vector3d::Zero();  ///< estimated less true centre in world [m]
    Eigen::Vector3d rotation_error = Eigen::Vector3d::Zero();  ///< from the true axes to the estimated [rad]
    double position_sigma = 0.0;                               ///< m, root of the trace
    double orientation_sigma = 0.0;                            ///< rad
    double position_bound = 0.0;                               ///< m: no estimate can be better
    double residual_px = 0.0;
    double effective_sample_size = 0.0;  ///< of its calibrator's hypotheses
    double latency_ms = 0.0;             ///< mid-exposure to its use, newest frame
    std::uint16_t selected = 0;  ///< bit m: marker m was used in its newest frame
    CameraStatus status = CameraStatus::kUncalibrated;
    bool covered = false;  ///< by the operator's order or board, or by one of the simulation
  };
  double time_s = 0.0;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();     ///< tracked, from where it stood on the pad [m]
  Eigen::Vector3d truth = Eigen::Vector3d::Zero();        ///< likewise
  Eigen::Vector3d reference = Eigen::Vector3d::Zero();    ///< likewise
  double yaw = 0.0, true_yaw = 0.0, reference_yaw = 0.0;  ///< rad
  double position_error = 0.0, orientation_error = 0.0;   ///< m, rad
  double position_sigma = 0.0;                            ///< m, root of the trace
  StickDemand sticks;
  double server_p99_ms = 0.0, command_p99_ms = 0.0;
  std::vector<Camera> cameras;
};

/// What a session's figures and report say.
struct SessionSummary {
  SessionSettings settings;
  std::string file;
  bool complete = false;  ///< the file was closed properly
  double begin_s = 0.0, end_s = 0.0;
  double rotors_on_s = 0.0;  ///< when they first turned; NaN if they never did
  std::uint64_t ticks = 0;
  FlightScore score;
  EngineSnapshot last;  ///< without its words
  std::string crash_reason;
  std::vector<EngineEvent> events;
  std::vector<SessionSample> samples;  ///< all ticks of a few minutes; of longer flights every so many
  std::vector<std::string> methods;    ///< by which each camera's pose was learnt; empty: it was given
};

/// Goes through the session, or a span of it, once. Throws Error(kInput) when it is none of ours.
SessionSummary summarize(McapReader& session, const ExportProgress& progress, const ExportSpan& span = {});
/// Several sessions, one after the other, of which `progress` hears as of one.
std::vector<SessionSummary> summarizeAll(const std::vector<std::string>& files, const ExportProgress& progress);

}  // namespace helical
