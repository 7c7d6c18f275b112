#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <iterator>

#include "engine/session/flight_messages.h"

namespace helical {
namespace {

TimeNs getTime(CdrReader& in) {
  const TimeNs seconds = in.get<std::int32_t>();
  return seconds * kNanosecondsPerSecond + in.get<std::uint32_t>();
}

Eigen::Vector3d getVector(CdrReader& in) {
  Eigen::Vector3d vector;
  for (double& value : vector) value = in.get<double>();
  return vector;
}

Matrix6d getMatrix(CdrReader& in) {
  Matrix6d matrix;
  for (Eigen::Index row = 0; row < 6; ++row)
    for (Eigen::Index column = 0; column < 6; ++column) matrix(row, column) = in.get<double>();
  return matrix;
}

/// A number that the enumeration does not have is its last value.
template <class Enum>
Enum getEnum(CdrReader& in, Enum last) {
  return static_cast<Enum>(std::min<int>(in.get<std::uint8_t>(), static_cast<int>(last)));
}

/// Null where there is none.
const char* getWord(CdrReader& in, Words& words) {
  const std::string_view word = in.getText();
  return word.empty() ? nullptr : words.keep(word);
}

RigidTransform getPose(CdrReader& in) {
  RigidTransform pose;
  for (double& value : pose.translation) value = in.get<double>();
  for (double& value : pose.rotation.coeffs()) value = in.get<double>();
  return pose;
}

void skipHeader(CdrReader& in) {
  in.get<std::int32_t>();
  in.get<std::uint32_t>();
  in.getText();
}

TriedLabellings getLabellings(CdrReader& in) {
  TriedLabellings labellings = readNames(in.getText());
  for (TriedLabelling& labelling : labellings.all) labelling.value = in.get<float>();
  labellings.by_misfit = in.getBool();
  return labellings;
}

Centroid getCentroid(CdrReader& in) {
  Centroid centroid;
  for (double& value : centroid.pixel) value = in.get<double>();
  for (int i = 0; i < 4; ++i) centroid.covariance(i / 2, i % 2) = in.get<double>();
  centroid.area_px = in.get<double>();
  centroid.radius_px = in.get<double>();
  centroid.colour = in.get<std::int32_t>();
  in.get<std::int32_t>();
  in.getBool();
  in.getBool();
  in.get<double>();
  in.get<double>();
  return centroid;
}

DeviceStatus getDevices(CdrReader& in) {
  DeviceStatus devices;
  TransmitterStatus& transmitter = devices.transmitter;
  RecordHealth& record = devices.record;
  for (bool* value : {&transmitter.present, &transmitter.self_test_passed, &transmitter.channels_calibrated,
                      &transmitter.fault, &transmitter.pilot_flies, &transmitter.bench, &record.recording,
                      &record.cut_off, &record.stalled})
    *value = in.getBool();
  record.lost = in.get<std::uint64_t>();
  record.lost_images = in.get<std::uint64_t>();
  record.disk_free_gb = in.get<double>();
  return devices;
}

}  // namespace

DecodedObservation decodeObservation(std::string_view payload) {
  CdrReader in(payload);
  skipHeader(in);
  DecodedObservation decoded;
  Observation& observation = decoded.observation;
  decoded.order = in.get<std::uint64_t>();
  decoded.used = in.get<TimeNs>();
  observation.sequence = in.get<std::uint64_t>();
  observation.exposure = in.get<TimeNs>();
  observation.arrival = in.get<TimeNs>();
  observation.extraction = in.get<TimeNs>();
  observation.truncated = in.getBool();
  const auto count = in.get<std::uint32_t>();
  if (count > kMaxCentroids) throw CutShort();
  observation.count = static_cast<int>(count);
  for (std::size_t i = 0; i < count; ++i) observation.centroids[i] = getCentroid(in);
  return decoded;
}

DecodedTick decodeFlightState(std::string_view payload, EngineSnapshot& state, Words& words) {
  CdrReader in(payload);
  skipHeader(in);
  DecodedTick tick;
  tick.order = in.get<std::uint64_t>();
  state.time = in.get<TimeNs>();
  state.tick = in.get<std::uint64_t>();
  tick.commands.arm = in.getBool();
  tick.commands.disarm = in.getBool();
  tick.commands.take_off = in.getBool();
  tick.commands.hold = in.getBool();
  tick.commands.land = in.getBool();
  tick.commands.kill = in.getBool();
  state.phase = getEnum(in, FlightPhase::kOff);
  in.getText();
  state.safety = getEnum(in, SafetyState::kCut);
  in.getText();
  state.failsafes = in.get<std::uint32_t>();
  state.alarms = in.get<std::uint32_t>();
  state.armed = in.getBool();
  state.failing_checks = in.get<std::uint32_t>();
  state.arm_refused = in.get<std::uint32_t>();
  state.holding = in.getBool();
  tick.devices = state.devices = getDevices(in);
  state.pose_known = in.getBool();
  state.pose_age = in.get<TimeNs>();
  state.hovering = in.getBool();
  state.flight_time_s = in.get<double>();
  state.pad_height = in.get<double>();
  for (TimeNs* time :
       {&state.server_p50, &state.server_p99, &state.frame_to_command_p50, &state.frame_to_command_p99})
    *time = in.get<TimeNs>();
  state.ticks_per_second = in.get<double>();
  state.obstacle = getWord(in, words);
  state.refusal = getWord(in, words);
  state.gust_ordered = in.getBool();
  state.has_truth = in.getBool();
  state.verdict.crashed = in.getBool();
  state.verdict.reason = words.keep(in.getText());
  state.verdict.crash_time_s = in.get<double>();
  state.verdict.has_flown = in.getBool();
  state.verdict.at_rest = in.getBool();
  state.verdict.hardest_touch = in.get<double>();
  if (in.atEnd()) return tick;  // of a session from before these were written
  state.plans = in.get<std::uint32_t>();
  state.controls = in.get<std::uint32_t>();
  state.colours = in.get<std::uint32_t>();
  state.cameras_disagree = in.getBool();
  state.cold_start = getWord(in, words);
  if (in.atEnd()) return tick;  // likewise
  const std::string_view streams = in.getBytes();
  for (std::size_t i = 0; i < std::min(streams.size(), state.streams.size()); ++i)
    if (const int stream = static_cast<unsigned char>(streams[i]); stream < state.camera_count)
      state.streams[i] = cameraId(stream);
  return tick;
}

void decodeCameraState(std::string_view payload, CameraSnapshot& camera, Words& words) {
  CdrReader in(payload);
  skipHeader(in);
  camera.estimate.status = getEnum(in, CameraStatus::kRejected);
  in.getText();
  camera.hidden = in.getBool();
  camera.calibration_method = getWord(in, words);
  camera.effective_sample_size = in.get<double>();
  camera.boards = in.get<std::int32_t>();
  camera.knocks = in.get<std::uint32_t>();
  camera.frames = in.get<std::uint64_t>();
  camera.dropped = in.get<std::uint64_t>();
  camera.frames_per_second = in.get<double>();
  for (TimeNs* time : {&camera.latency, &camera.extraction_p50, &camera.extraction_p99})
    *time = in.get<TimeNs>();
  camera.centroids = in.get<std::int32_t>();
  camera.knocks_found = in.get<std::int32_t>();
  const bool bound_known = in.getBool();
  CalibrationBound bound;
  bound.position_m = in.get<double>();
  bound.orientation_rad = in.get<double>();
  camera.calibration_bound = bound_known ? std::optional(bound) : std::nullopt;
  if (in.atEnd()) return;  // of a session from before these were written
  camera.frozen = in.getBool();
  camera.lost_share = in.get<double>();
  camera.noise = in.get<double>();
  camera.backgrounds = in.get<std::uint32_t>();
  camera.link = getEnum(in, LinkState::kOpening);
  camera.returns = in.get<std::uint64_t>();
  camera.resent_packets = in.get<std::uint64_t>();
  camera.transfer = in.get<TimeNs>();
  camera.clock_sigma_s = in.get<double>();
  if (in.atEnd()) return;  // likewise
  camera.light.exposure_us = in.get<double>();
  camera.light.gain = in.get<double>();
  camera.light.gain_in_db = in.getBool();
  camera.labellings = getLabellings(in);
  if (!in.atEnd()) camera.focal_scale = in.get<double>();
}

void decodeTrackedPose(std::string_view payload, TrackedState& tracked) {
  CdrReader in(payload);
  tracked.time = getTime(in);
  in.getText();
  RigidTransform& pose = tracked.state.world_from_body;
  pose = getPose(in);
  Matrix6d body_axes = Matrix6d::Identity();
  body_axes.bottomRightCorner<3, 3>() = pose.rotation.toRotationMatrix().transpose();
  tracked.pose_covariance = body_axes * getMatrix(in) * body_axes.transpose();
}

void decodeVelocity(std::string_view payload, HelicopterState& state) {
  CdrReader in(payload);
  skipHeader(in);
  state.velocity_in_world = getVector(in);
  state.angular_velocity_in_body = state.world_from_body.rotation.inverse() * getVector(in);
}

void decodeSetPointPose(std::string_view payload, SetPoint& set_point) {
  const RigidTransform pose = decodePose(payload);
  set_point.position_in_world = pose.translation;
  set_point.yaw = 2.0 * std::atan2(pose.rotation.z(), pose.rotation.w());
}

void decodeSetPointVelocity(std::string_view payload, SetPoint& set_point) {
  CdrReader in(payload);
  skipHeader(in);
  set_point.velocity_in_world = getVector(in);
}

StickDemand decodeSticks(std::string_view payload) {
  CdrReader in(payload);
  skipHeader(in);
  StickDemand sticks;
  for (double* value : {&sticks.upper_rotor, &sticks.lower_rotor, &sticks.roll, &sticks.pitch})
    *value = in.get<double>();
  return sticks;
}

void decodeExtrinsics(std::string_view payload, CameraEstimate& estimate) {
  CdrReader in(payload);
  skipHeader(in);
  const RigidTransform world_from_camera = getPose(in);
  estimate.camera_from_world = world_from_camera.inverse();
  // The way back from encodeExtrinsics.
  Matrix6d ours_from_ros = Matrix6d::Zero();
  ours_from_ros.bottomLeftCorner<3, 3>().setIdentity();
  ours_from_ros.topRightCorner<3, 3>() = -world_from_camera.rotation.toRotationMatrix().transpose();
  estimate.covariance = ours_from_ros * getMatrix(in) * ours_from_ros.transpose();
}

CameraTrack decodeTrack(std::string_view payload) {
  CdrReader in(payload);
  CameraTrack track;
  track.exposure = getTime(in);
  in.getText();
  for (int* count : {&track.predicted_count, &track.agreeing_count, &track.selected_count})
    *count = in.get<std::int32_t>();
  track.residual_px = in.get<double>();
  const auto markers = in.get<std::uint32_t>();
  if (markers > kMaxMarkers) throw CutShort();
  for (std::size_t m = 0; m < markers; ++m) {
    MarkerTrack& marker = track.markers[m];
    for (bool* flag : {&marker.observed, &marker.agrees, &marker.selected, &marker.predicted})
      *flag = in.getBool();
    for (double& value : marker.pixel) value = in.get<double>();
    for (double& value : marker.reprojected) value = in.get<double>();
  }
  return track;
}

EngineEvent decodeEvent(std::string_view payload) {
  CdrReader in(payload);
  EngineEvent event;
  event.time = getTime(in);
  const auto level = in.get<std::uint8_t>();
  const bool good = in.getText() == kGoodNews;
  event.severity = level >= kLogError     ? Severity::kDanger
                   : level >= kLogWarning ? Severity::kCaution
                   : good                 ? Severity::kGood
                                          : Severity::kInfo;
  const std::string_view text = in.getText();
  const std::size_t size = std::min(text.size(), event.text.size() - 1);
  std::copy_n(text.data(), size, event.text.data());
  return event;
}

DecodedOrder decodeOrder(std::string_view payload) {
  CdrReader in(payload);
  skipHeader(in);
  DecodedOrder order;
  order.order = in.get<std::uint64_t>();
  order.time = in.get<TimeNs>();
  order.kind = in.getText();
  order.camera = in.get<std::int32_t>();
  order.method = in.getText();
  order.seed = in.get<std::uint64_t>();
  if (in.atEnd()) return order;  // recorded before there were such decisions
  CalibrationOrder decided;
  decided.camera = cameraId(std::clamp(order.camera, 0, kMaxCameras - 1));
  std::array<double, 4> q;
  for (double& each : q) each = in.get<double>();
  decided.camera_from_world.rotation = Eigen::Quaterniond(q[0], q[1], q[2], q[3]);
  for (double& each : decided.camera_from_world.translation) each = in.get<double>();
  for (int row = 0; row < 6; ++row)
    for (int column = 0; column < 6; ++column) decided.covariance(row, column) = in.get<double>();
  if (!in.atEnd()) decided.focal_scale = in.get<double>();
  if (!in.atEnd()) decided.balls_off_m = in.get<double>();
  for (const CalibrationOrderKind kind : kCalibrationOrderKinds)
    if (order.kind == toString(kind)) {
      decided.kind = kind;
      order.decided = decided;
    }
  return order;
}

void decodeBelief(std::string_view payload, CalibrationView& view) {
  CdrReader in(payload);
  skipHeader(in);
  in.get<std::uint32_t>();
  const auto count = in.get<std::uint32_t>();
  if (count > CalibrationView::kMaxParticles || in.get<std::uint32_t>() != std::size(kBeliefFields))
    throw CutShort();
  for (const char* name : kBeliefFields) {
    if (in.getText() != name) throw CutShort();
    in.get<std::uint32_t>();
    in.get<std::uint8_t>();
    in.get<std::uint32_t>();
  }
  in.getBool();
  in.get<std::uint32_t>();
  in.get<std::uint32_t>();
  ByteReader points(in.getBytes());
  view.count = view.total = static_cast<int>(count);
  for (std::size_t i = 0; i < count; ++i) {
    for (float& value : view.particles[i].centre_in_world) value = points.get<float>();
    view.particles[i].weight = points.get<float>();
  }
}

RigidTransform decodePose(std::string_view payload) {
  CdrReader in(payload);
  skipHeader(in);
  return getPose(in);
}

}  // namespace helical
