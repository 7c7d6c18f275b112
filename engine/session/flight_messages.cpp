#include "engine/session/flight_messages.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cstring>
#include <iterator>
#include <limits>
#include <span>

#include "engine/session/flight_change_text.h"
#include "engine/session/image_codec.h"

namespace helical {
namespace {

constexpr std::uint8_t kFloat32 = 7;  // of sensor_msgs/PointField
constexpr auto kBeliefStep = static_cast<std::uint32_t>(std::size(kBeliefFields) * sizeof(float));

void putTime(CdrWriter& out, TimeNs time) {
  const TimeNs seconds = time / kNanosecondsPerSecond;
  out.put(static_cast<std::int32_t>(seconds));
  out.put(static_cast<std::uint32_t>(std::max<TimeNs>(0, time - seconds * kNanosecondsPerSecond)));
}

void begin(CdrWriter& out, TimeNs time, std::string_view frame) {
  out.clear();
  putTime(out, time);
  out.putText(frame);
}

void putQuaternion(CdrWriter& out, const Eigen::Quaterniond& rotation) {
  out.putAll(rotation.coeffs());  // x y z w, as ROS has them
}

void putPose(CdrWriter& out, const RigidTransform& world_from_frame) {
  out.putAll(world_from_frame.translation);
  putQuaternion(out, world_from_frame.rotation);
}

/// A quaternion that means one yaw.
Eigen::Quaterniond heading(double yaw) {
  return Eigen::Quaterniond(Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()));
}

const char* statusName(CameraStatus status) {
  switch (status) {
    case CameraStatus::kUncalibrated:
      return "uncalibrated";
    case CameraStatus::kCalibrating:
      return "calibrating";
    case CameraStatus::kCalibrated:
      return "calibrated";
    case CameraStatus::kRejected:
      return "rejected";
  }
  return "";
}

std::uint8_t logLevel(Severity severity) {
  switch (severity) {
    case Severity::kInfo:
    case Severity::kGood:
      return kLogInfo;
    case Severity::kCaution:
      return kLogWarning;
    case Severity::kDanger:
      return kLogError;
  }
  return kLogInfo;
}

/// The marker that was seen in a centroid; -1 if none was.
int markerOf(const Centroid& centroid, const CameraTrack& track, int markers) {
  for (int m = 0; m < markers; ++m) {
    const MarkerTrack& marker = track.markers[static_cast<std::size_t>(m)];
    if (marker.observed && marker.pixel == centroid.pixel) return m;
  }
  return -1;
}

void putCentroid(CdrWriter& out, const Centroid& centroid, const CameraTrack& track, int marker) {
  const MarkerTrack named = marker < 0 ? MarkerTrack{} : track.markers[static_cast<std::size_t>(marker)];
  out.putAll(centroid.pixel);
  out.putAll(centroid.covariance);
  out.put(centroid.area_px);
  out.put(centroid.radius_px);
  out.put(static_cast<std::int32_t>(centroid.colour));
  out.put(static_cast<std::int32_t>(marker));
  out.put(named.selected);
  out.put(named.predicted);
  out.putAll(named.reprojected);
}

void putDevices(CdrWriter& out, const DeviceStatus& devices) {
  const TransmitterStatus& transmitter = devices.transmitter;
  for (const bool value : {transmitter.present, transmitter.self_test_passed, transmitter.channels_calibrated,
                           transmitter.fault, transmitter.pilot_flies, transmitter.bench,
                           devices.record.recording, devices.record.cut_off, devices.record.stalled})
    out.put(value);
  out.put(devices.record.lost);
  out.put(devices.record.lost_images);
  out.put(devices.record.disk_free_gb);
}

void putLabellings(CdrWriter& out, const TriedLabellings& labellings) {
  LabellingNames text;
  out.putText(writeNames(labellings, text));
  for (int i = 0; i < TriedLabellings::kMost; ++i)
    out.put(i < labellings.count ? labellings.all[static_cast<std::size_t>(i)].value
                                 : std::numeric_limits<float>::quiet_NaN());
  out.put(labellings.by_misfit);
}

}  // namespace

std::string cameraFrame(const CameraConfig& camera) {
  return "camera_" + camera.label;
}

void encodePose(CdrWriter& out, TimeNs time, const RigidTransform& world_from_frame) {
  begin(out, time, kWorldFrame);
  putPose(out, world_from_frame);
}

void encodeVelocity(CdrWriter& out, TimeNs time, const HelicopterState& state) {
  begin(out, time, kWorldFrame);
  out.putAll(state.velocity_in_world);
  out.putAll(Eigen::Vector3d(state.world_from_body.rotation * state.angular_velocity_in_body));
}

void encodeTrackedPose(CdrWriter& out, const TrackedState& tracked) {
  const RigidTransform& pose = tracked.state.world_from_body;
  // Ours turns about the body's axes.
  Matrix6d world_axes = Matrix6d::Identity();
  world_axes.bottomRightCorner<3, 3>() = pose.rotation.toRotationMatrix();
  begin(out, tracked.time, kWorldFrame);
  putPose(out, pose);
  out.putAll(Matrix6d(world_axes * tracked.pose_covariance * world_axes.transpose()));
}

void encodeSetPointPose(CdrWriter& out, TimeNs time, const SetPoint& set_point) {
  encodePose(out, time, {heading(set_point.yaw), set_point.position_in_world});
}

void encodeSetPointVelocity(CdrWriter& out, TimeNs time, const SetPoint& set_point) {
  begin(out, time, kWorldFrame);
  out.putAll(set_point.velocity_in_world);
  out.putAll(Eigen::Vector3d(Eigen::Vector3d::Zero()));
}

void encodeSticks(CdrWriter& out, TimeNs time, const StickDemand& sticks) {
  begin(out, time, kHelicopterFrame);
  for (const double value : {sticks.upper_rotor, sticks.lower_rotor, sticks.roll, sticks.pitch})
    out.put(value);
}

void encodeExtrinsics(CdrWriter& out, TimeNs time, const CameraEstimate& estimate) {
  const RigidTransform world_from_camera = estimate.camera_from_world.inverse();
  // Ours turns camera_from_world about the camera's axes: world_from_camera turns the other way about the
  // world's; and it has the rotation first.
  Matrix6d ros_from_ours = Matrix6d::Zero();
  ros_from_ours.topRightCorner<3, 3>().setIdentity();
  ros_from_ours.bottomLeftCorner<3, 3>() = -world_from_camera.rotation.toRotationMatrix();
  begin(out, time, kWorldFrame);
  putPose(out, world_from_camera);
  out.putAll(Matrix6d(ros_from_ours * estimate.covariance * ros_from_ours.transpose()));
}

void encodeCameraState(CdrWriter& out, TimeNs time, const CameraSnapshot& camera) {
  begin(out, time, kWorldFrame);
  out.put(static_cast<std::uint8_t>(camera.estimate.status));
  out.putText(statusName(camera.estimate.status));
  out.put(camera.hidden);
  out.putText(camera.calibration_method != nullptr ? camera.calibration_method : "");
  out.put(camera.effective_sample_size);
  out.put(static_cast<std::int32_t>(camera.boards));
  out.put(camera.knocks);
  out.put(camera.frames);
  out.put(camera.dropped);
  out.put(camera.frames_per_second);
  for (const TimeNs time_ns : {camera.latency, camera.extraction_p50, camera.extraction_p99})
    out.put(time_ns);
  const CalibrationBound bound = camera.calibration_bound.value_or(CalibrationBound{});
  out.put(static_cast<std::int32_t>(camera.centroids));
  out.put(static_cast<std::int32_t>(camera.knocks_found));
  out.put(camera.calibration_bound.has_value());
  out.put(bound.position_m);
  out.put(bound.orientation_rad);
  out.put(camera.frozen);
  out.put(camera.lost_share);
  out.put(camera.noise);
  out.put(camera.backgrounds);
  out.put(static_cast<std::uint8_t>(camera.link));
  out.put(camera.returns);
  out.put(camera.resent_packets);
  out.put(camera.transfer);
  out.put(camera.clock_sigma_s);
  out.put(camera.light.exposure_us);
  out.put(camera.light.gain);
  out.put(camera.light.gain_in_db);
  putLabellings(out, camera.labellings);
  out.put(camera.focal_scale);
}

void encodeCameraInfo(CdrWriter& out, const CameraConfig& camera) {
  const CameraModel& model = camera.model;
  begin(out, 0, cameraFrame(camera));
  out.put(static_cast<std::uint32_t>(model.height()));
  out.put(static_cast<std::uint32_t>(model.width()));
  out.putText(model.rational() ? "rational_polynomial" : "plumb_bob");
  const std::span distortion = std::span(model.distortion()).first(model.rational() ? 8 : 5);
  out.put(static_cast<std::uint32_t>(distortion.size()));
  for (const double value : distortion) out.put(value);
  Eigen::Matrix<double, 3, 4> projection = Eigen::Matrix<double, 3, 4>::Zero();
  projection.leftCols<3>() << model.fx(), 0.0, model.cx(), 0.0, model.fy(), model.cy(), 0.0, 0.0, 1.0;
  out.putAll(projection.leftCols<3>());
  out.putAll(Eigen::Matrix3d(Eigen::Matrix3d::Identity()));
  out.putAll(projection);
  for (int i = 0; i < 6; ++i) out.put(std::uint32_t{0});  // no binning, no region
  out.put(false);
}

void encodeObservation(CdrWriter& out, std::uint64_t order, const UsedObservation& used, int markers,
                       const std::string& frame) {
  const Observation& observation = used.observation;
  begin(out, observation.exposure, frame);
  out.put(order);
  out.put(used.used);
  out.put(observation.sequence);
  out.put(observation.exposure);
  out.put(observation.arrival);
  out.put(observation.extraction);
  out.put(observation.truncated);
  out.put(static_cast<std::uint32_t>(observation.count));
  const bool looked_at = used.track.exposure == observation.exposure;
  for (int i = 0; i < observation.count; ++i) {
    const Centroid& centroid = observation.centroids[static_cast<std::size_t>(i)];
    putCentroid(out, centroid, used.track, looked_at ? markerOf(centroid, used.track, markers) : -1);
  }
}

void encodeTrack(CdrWriter& out, const UsedObservation& used, int markers, const std::string& frame) {
  const CameraTrack& track = used.track;
  begin(out, track.exposure, frame);
  for (const int count : {track.predicted_count, track.agreeing_count, track.selected_count})
    out.put(static_cast<std::int32_t>(count));
  out.put(track.residual_px);
  out.put(static_cast<std::uint32_t>(markers));
  for (int m = 0; m < markers; ++m) {
    const MarkerTrack& marker = track.markers[static_cast<std::size_t>(m)];
    for (const bool flag : {marker.observed, marker.agrees, marker.selected, marker.predicted}) out.put(flag);
    out.putAll(marker.pixel);
    out.putAll(marker.reprojected);
  }
}

void encodeBelief(CdrWriter& out, const CameraBelief& belief) {
  const CalibrationView& view = belief.view;
  begin(out, belief.time, kWorldFrame);
  out.put(std::uint32_t{1});
  out.put(static_cast<std::uint32_t>(view.count));
  out.put(static_cast<std::uint32_t>(std::size(kBeliefFields)));
  for (std::uint32_t i = 0; i < std::size(kBeliefFields); ++i) {
    out.putText(kBeliefFields[i]);
    out.put(static_cast<std::uint32_t>(i * sizeof(float)));
    out.put(kFloat32);
    out.put(std::uint32_t{1});
  }
  out.put(false);
  out.put(kBeliefStep);
  out.put(kBeliefStep * static_cast<std::uint32_t>(view.count));
  ByteWriter points;
  for (int i = 0; i < view.count; ++i) {
    const CalibrationView::Particle& particle = view.particles[static_cast<std::size_t>(i)];
    for (const float value : particle.centre_in_world) points.put(value);
    points.put(particle.weight);
  }
  out.putBytes(points.bytes());
  out.put(true);
}

void encodeImage(CdrWriter& out, const RecordedFrame& image, const std::string& frame) {
  begin(out, image.exposure, frame);
  out.put(static_cast<std::uint32_t>(image.height));
  out.put(static_cast<std::uint32_t>(image.width));
  out.putText(encodingName(image.format));
  out.put(false);
  out.put(static_cast<std::uint32_t>(image.width * bytesPerPixel(image.format)));
  out.putBytes({reinterpret_cast<const char*>(image.pixels.data()), image.pixels.size()});
}

void encodeJpeg(CdrWriter& out, const RecordedFrame& image, const std::string& frame) {
  begin(out, image.exposure, frame);
  out.putText("jpeg");
  out.putBytes(jpegOf(image));
}

void encodeFlightState(CdrWriter& out, std::uint64_t order, const FlightTick& tick) {
  const EngineSnapshot& state = tick.state;
  begin(out, state.time, kWorldFrame);
  out.put(order);
  out.put(state.time);
  out.put(state.tick);
  out.put(tick.commands.arm);
  out.put(tick.commands.disarm);
  out.put(tick.commands.take_off);
  out.put(tick.commands.hold);
  out.put(tick.commands.land);
  out.put(tick.commands.kill);
  out.put(static_cast<std::uint8_t>(state.phase));
  out.putText(toString(state.phase));
  out.put(static_cast<std::uint8_t>(state.safety));
  out.putText(toString(state.safety));
  out.put(state.failsafes);
  out.put(state.alarms);
  out.put(state.armed);
  out.put(state.failing_checks);
  out.put(state.arm_refused);
  out.put(state.holding);
  putDevices(out, state.devices);
  out.put(state.pose_known);
  out.put(state.pose_age);
  out.put(state.hovering);
  out.put(state.flight_time_s);
  out.put(state.pad_height);
  for (const TimeNs time :
       {state.server_p50, state.server_p99, state.frame_to_command_p50, state.frame_to_command_p99})
    out.put(time);
  out.put(state.ticks_per_second);
  out.putText(state.obstacle != nullptr ? state.obstacle : "");
  out.putText(state.refusal != nullptr ? state.refusal : "");
  out.put(state.gust_ordered);
  out.put(state.has_truth);
  out.put(state.verdict.crashed);
  out.putText(state.verdict.reason);
  out.put(state.verdict.crash_time_s);
  out.put(state.verdict.has_flown);
  out.put(state.verdict.at_rest);
  out.put(state.verdict.hardest_touch);
  out.put(state.plans);
  out.put(state.controls);
  out.put(state.colours);
  out.put(state.cameras_disagree);
  out.putText(state.cold_start != nullptr ? state.cold_start : "");
  out.put(static_cast<std::uint32_t>(state.camera_count));
  for (int i = 0; i < state.camera_count; ++i) out.put(state.streams[static_cast<std::size_t>(i)].value);
}

namespace {

void putOrder(CdrWriter& out, std::uint64_t order, TimeNs time, const char* kind, CameraId camera,
              std::string_view method, std::uint64_t seed, const CalibrationOrder& decided) {
  begin(out, time, kWorldFrame);
  out.put(order);
  out.put(time);
  out.putText(kind);
  out.put(static_cast<std::int32_t>(camera.index()));
  out.putText(method);
  out.put(seed);
  const Eigen::Quaterniond& q = decided.camera_from_world.rotation;
  out.putAll(Eigen::Vector4d(q.w(), q.x(), q.y(), q.z()));
  out.putAll(decided.camera_from_world.translation);
  out.putAll(decided.covariance);
  out.put(decided.focal_scale);
  out.put(decided.balls_off_m);
}

}  // namespace

void encodeOrder(CdrWriter& out, std::uint64_t order, const CameraHidden& hidden) {
  putOrder(out, order, hidden.time, hidden.hidden ? "hide" : "show", hidden.camera, "", 0, {});
}

void encodeOrder(CdrWriter& out, std::uint64_t order, const CalibrationBegun& begun) {
  putOrder(out, order, begun.time, "calibrate", begun.camera, begun.method, begun.seed, {});
}

void encodeOrder(CdrWriter& out, std::uint64_t order, const CalibrationDecided& decided) {
  putOrder(out, order, decided.time, toString(decided.what.kind), decided.what.camera, "", 0, decided.what);
}

void encodeOrder(CdrWriter& out, std::uint64_t order, const FlightChanged& changed) {
  putOrder(out, order, changed.time, "change", CameraId(), textOf(*changed.change), 0, {});
}

void encodeEvent(CdrWriter& out, const EngineEvent& event) {
  out.clear();
  putTime(out, event.time);
  out.put(logLevel(event.severity));
  out.putText(event.severity == Severity::kGood ? kGoodNews : "helical");
  out.putText({event.text.data(), ::strnlen(event.text.data(), event.text.size())});
  out.putText("");
  out.putText("");
  out.put(std::uint32_t{0});
}

void encodeTransforms(CdrWriter& out, TimeNs time, std::span<const NamedTransform> transforms) {
  out.clear();
  out.put(static_cast<std::uint32_t>(transforms.size()));
  for (const NamedTransform& transform : transforms) {
    putTime(out, time);
    out.putText(kWorldFrame);
    out.putText(transform.frame);
    putPose(out, transform.world_from_frame);
  }
}

}  // namespace helical
