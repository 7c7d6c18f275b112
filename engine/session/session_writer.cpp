#include "engine/session/session_writer.h"

#include <algorithm>
#include <cctype>

#include "engine/session/flight_messages.h"

namespace helical {
namespace {

// What does not change is repeated this often: a viewer that opens the file in the middle sees it, too.
constexpr TimeNs kRepeat = kNanosecondsPerSecond;
constexpr TimeNs kCameraStatePeriod = 100 * kNanosecondsPerMillisecond;

bool sameEstimate(const CameraEstimate& a, const CameraEstimate& b) {
  return a.camera_from_world.rotation.coeffs() == b.camera_from_world.rotation.coeffs() &&
         a.camera_from_world.translation == b.camera_from_world.translation && a.covariance == b.covariance;
}

std::string topicWord(const std::string& label) {
  std::string word = label;
  for (char& letter : word)
    if (std::isalnum(static_cast<unsigned char>(letter)) == 0) letter = '_';
  return word;
}

}  // namespace

std::string cameraTopic(const RigConfig& rig, std::size_t camera) {
  const std::string word = topicWord(rig.cameras[camera].label);
  const auto same = std::count_if(rig.cameras.begin(), rig.cameras.end(),
                                  [&](const CameraConfig& other) { return topicWord(other.label) == word; });
  return "/cameras/" + (same > 1 ? word + "__" + std::to_string(camera + 1) : word) + "/";
}

SessionWriter::SessionWriter(const std::filesystem::path& file, const SessionSettings& settings)
    : mcap_(file, "helical"), markers_(settings.rig.markers_in_body.count()) {
  for (const auto& attachment : toAttachments(settings)) mcap_.addAttachment(attachment);
  for (int kind = 0; kind < kMessageKinds; ++kind)
    schemas_[static_cast<std::size_t>(kind)] =
        mcap_.addSchema(messageName(static_cast<MessageKind>(kind)), "ros2msg",
                        messageDefinition(static_cast<MessageKind>(kind)));
  pose_ = channel(kPoseTopic, MessageKind::kPoseWithCovarianceStamped);
  velocity_ = channel(kVelocityTopic, MessageKind::kTwistStamped);
  set_point_pose_ = channel(kSetPointTopic, MessageKind::kPoseStamped);
  set_point_velocity_ = channel(kSetPointVelocityTopic, MessageKind::kTwistStamped);
  sticks_ = channel(kSticksTopic, MessageKind::kStickDemand);
  flight_state_ = channel(kFlightStateTopic, MessageKind::kFlightState);
  orders_ = channel(kOrdersTopic, MessageKind::kOperatorOrder);
  events_ = channel(kEventsTopic, MessageKind::kLog);
  transforms_ = channel("/tf", MessageKind::kTransforms);
  true_pose_ = channel(kTruePoseTopic, MessageKind::kPoseStamped);
  true_velocity_ = channel(kTrueVelocityTopic, MessageKind::kTwistStamped);
  addCameras(settings);
  flush();
  sync();
}

void SessionWriter::addCameras(const SessionSettings& settings) {
  const RigConfig& rig = settings.rig;
  for (std::size_t i = 0; i < rig.cameras.size(); ++i) {
    const std::string topic = cameraTopic(rig, i);
    CameraChannels camera;
    camera.frame = cameraFrame(rig.cameras[i]);
    camera.observation = channel(topic + "observation", MessageKind::kObservation);
    camera.extrinsics = channel(topic + "extrinsics", MessageKind::kPoseWithCovarianceStamped);
    camera.state = channel(topic + "state", MessageKind::kCameraState);
    camera.info = channel(topic + "camera_info", MessageKind::kCameraInfo);
    camera.truth = channel(topic + "true_pose", MessageKind::kPoseStamped);
    camera.track = channel(topic + "track", MessageKind::kCameraTrack);
    camera.belief = channel(topic + "particles", MessageKind::kPointCloud);
    if (i < settings.images.size()) camera.quality = settings.images[i].quality;
    if (camera.quality == ImageQuality::kJpeg)
      camera.image = channel(topic + kJpegTopic, MessageKind::kCompressedImage);
    if (camera.quality == ImageQuality::kLossless)
      camera.image = channel(topic + kImageTopic, MessageKind::kImage);
    encodeCameraInfo(out_, rig.cameras[i]);
    send(camera.info, 0);
    cameras_.push_back(camera);
  }
}

std::uint16_t SessionWriter::channel(const std::string& topic, MessageKind kind) {
  return mcap_.addChannel(schemas_[static_cast<std::size_t>(kind)], topic, "cdr",
                          weightOf(messageName(kind)));
}

void SessionWriter::add(const FlightItem& item) {
  std::visit([&](const auto& what) { write(item.order, what); }, item.what);
}

void SessionWriter::write(std::uint64_t, const EngineEvent& event) {
  encodeEvent(out_, event);
  send(events_, event.time);
}

void SessionWriter::write(std::uint64_t order, const UsedObservation& used) {
  const CameraChannels& camera = cameras_.at(static_cast<std::size_t>(used.observation.camera.index()));
  encodeObservation(out_, order, used, markers_, camera.frame);
  mcap_.addMessage(camera.observation, used.used, used.observation.exposure, out_.bytes());
  if (used.track.exposure != used.observation.exposure) return;  // came too late for the tracker
  encodeTrack(out_, used, markers_, camera.frame);
  mcap_.addMessage(camera.track, used.used, used.observation.exposure, out_.bytes());
}

void SessionWriter::write(std::uint64_t, const CameraBelief& belief) {
  CameraChannels& camera = cameras_.at(static_cast<std::size_t>(belief.camera.index()));
  if (belief.view.count == 0) return;  // a method without hypotheses
  if (camera.belief_written >= 0 && belief.time - camera.belief_written < kCameraStatePeriod) return;
  camera.belief_written = belief.time;
  encodeBelief(out_, belief);
  send(camera.belief, belief.time);
}

void SessionWriter::addFrame(CameraId id, const RecordedFrame& frame) {
  const CameraChannels& camera = cameras_.at(static_cast<std::size_t>(id.index()));
  if (camera.quality == ImageQuality::kJpeg)
    encodeJpeg(out_, frame, camera.frame);
  else
    encodeImage(out_, frame, camera.frame);
  mcap_.addMessage(camera.image, frame.arrival, frame.exposure, out_.bytes());
}

void SessionWriter::write(std::uint64_t order, const CameraHidden& hidden) {
  encodeOrder(out_, order, hidden);
  send(orders_, hidden.time);
}

void SessionWriter::write(std::uint64_t order, const CalibrationBegun& begun) {
  encodeOrder(out_, order, begun);
  send(orders_, begun.time);
}

void SessionWriter::write(std::uint64_t order, const CalibrationDecided& decided) {
  encodeOrder(out_, order, decided);
  send(orders_, decided.time);
}

void SessionWriter::write(std::uint64_t order, const FlightChanged& changed) {
  encodeOrder(out_, order, changed);
  send(orders_, changed.time);
}

void SessionWriter::write(std::uint64_t order, const FlightTick& tick) {
  const EngineSnapshot& state = tick.state;
  if (state.pose_known) {
    encodeTrackedPose(out_, state.tracked);
    send(pose_, state.time);
    encodeVelocity(out_, state.time, state.tracked.state);
    send(velocity_, state.time);
    const NamedTransform helicopter{kHelicopterFrame, state.tracked.state.world_from_body};
    encodeTransforms(out_, state.time, {&helicopter, 1});
    send(transforms_, state.time);
  }
  encodeSetPointPose(out_, state.time, state.set_point);
  send(set_point_pose_, state.time);
  encodeSetPointVelocity(out_, state.time, state.set_point);
  send(set_point_velocity_, state.time);
  encodeSticks(out_, state.time, state.sticks);
  send(sticks_, state.time);
  for (std::size_t i = 0; i < cameras_.size(); ++i) writeCamera(state, i);
  writeTruth(state);
  // Last: with it a reader has the whole tick.
  encodeFlightState(out_, order, tick);
  send(flight_state_, state.time);
}

void SessionWriter::writeTruth(const EngineSnapshot& state) {
  if (!state.has_truth) return;
  encodePose(out_, state.time, state.truth.world_from_body);
  send(true_pose_, state.time);
  encodeVelocity(out_, state.time, state.truth);
  send(true_velocity_, state.time);
}

void SessionWriter::writeCamera(const EngineSnapshot& state, std::size_t index) {
  CameraChannels& camera = cameras_[index];
  const CameraSnapshot& now = state.cameras[index];
  const bool first = camera.extrinsics_written < 0;
  const bool changed = now.estimate.status != camera.written.estimate.status ||
                       now.hidden != camera.written.hidden || now.knocks != camera.written.knocks ||
                       now.boards != camera.written.boards || now.frozen != camera.written.frozen ||
                       now.lost_share != camera.written.lost_share || now.noise != camera.written.noise ||
                       now.backgrounds != camera.written.backgrounds || now.link != camera.written.link;
  if (first || state.time - camera.extrinsics_written >= kRepeat ||
      !sameEstimate(now.estimate, camera.written.estimate)) {
    camera.extrinsics_written = state.time;
    if (now.estimate.status != CameraStatus::kUncalibrated) {
      encodeExtrinsics(out_, state.time, now.estimate);
      send(camera.extrinsics, state.time);
      const NamedTransform place{camera.frame, now.estimate.camera_from_world.inverse()};
      encodeTransforms(out_, state.time, {&place, 1});
      send(transforms_, state.time);
    }
    if (now.has_truth) {
      encodePose(out_, state.time, now.true_camera_from_world.inverse());
      send(camera.truth, state.time);
    }
    camera.written.estimate = now.estimate;
  }
  if (first || changed || state.time - camera.state_written >= kCameraStatePeriod) {
    camera.state_written = state.time;
    encodeCameraState(out_, state.time, now);
    send(camera.state, state.time);
    camera.written = now;
  }
}

}  // namespace helical
