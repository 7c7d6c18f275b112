#include "engine/session/flight_decoder.h"

#include "engine/session/session_writer.h"

namespace helical {

FlightDecoder::FlightDecoder(const McapReader& session, const RigConfig& rig) {
  std::map<std::string, Source> topics{{kPoseTopic, {Stream::kPose}},
                                       {kVelocityTopic, {Stream::kVelocity}},
                                       {kSetPointTopic, {Stream::kSetPointPose}},
                                       {kSetPointVelocityTopic, {Stream::kSetPointVelocity}},
                                       {kSticksTopic, {Stream::kSticks}},
                                       {kFlightStateTopic, {Stream::kFlightState}},
                                       {kEventsTopic, {Stream::kEvents}},
                                       {kTruePoseTopic, {Stream::kTruePose}},
                                       {kTrueVelocityTopic, {Stream::kTrueVelocity}}};
  for (std::size_t i = 0; i < rig.cameras.size(); ++i) {
    const std::string camera = cameraTopic(rig, i);
    topics[camera + "observation"] = {Stream::kObservation, i};
    topics[camera + "track"] = {Stream::kTrack, i};
    topics[camera + "extrinsics"] = {Stream::kExtrinsics, i};
    topics[camera + "state"] = {Stream::kCameraState, i};
    topics[camera + "true_pose"] = {Stream::kCameraTruth, i};
    topics[camera + "particles"] = {Stream::kBelief, i};
  }
  for (const auto& [id, channel] : session.channels()) {
    const auto topic = topics.find(channel.topic);
    if (topic != topics.end()) sources_[id] = topic->second;
  }
  initial_.camera_count = static_cast<int>(rig.cameras.size());
  initial_.marker_count = rig.markers_in_body.count();
  initial_.markers = rig.markers_in_body;
  restart();
}

void FlightDecoder::restart() {
  tick_ = initial_;
  for (CalibrationView& belief : beliefs_) belief.count = belief.total = 0;
}

FlightDecoder::Found FlightDecoder::take(const McapMessage& message) {
  const auto found = sources_.find(message.channel);
  if (found == sources_.end()) return Found::kNothing;
  const std::string_view payload = message.payload;
  switch (found->second.stream) {
    case Stream::kPose:
      decodeTrackedPose(payload, tick_.tracked);
      break;
    case Stream::kVelocity:
      decodeVelocity(payload, tick_.tracked.state);
      break;
    case Stream::kSetPointPose:
      decodeSetPointPose(payload, tick_.set_point);
      break;
    case Stream::kSetPointVelocity:
      decodeSetPointVelocity(payload, tick_.set_point);
      break;
    case Stream::kSticks:
      tick_.sticks = decodeSticks(payload);
      break;
    case Stream::kTruePose:
      tick_.truth.world_from_body = decodePose(payload);
      break;
    case Stream::kTrueVelocity:
      decodeVelocity(payload, tick_.truth);
      break;
    case Stream::kFlightState:
      decodeFlightState(payload, tick_, words_);
      return Found::kTick;
    case Stream::kEvents:
      event_ = decodeEvent(payload);
      return Found::kEvent;
    default:
      return takeOfCamera(found->second, payload);
  }
  return Found::kNothing;
}

std::size_t FlightDecoder::cameraBy(std::size_t stream) const {
  for (std::size_t i = 0; i < tick_.streams.size(); ++i)
    if (static_cast<std::size_t>(tick_.streams[i].index()) == stream) return i;
  return stream;  // of a damaged session
}

FlightDecoder::Found FlightDecoder::takeOfCamera(const Source& source, std::string_view payload) {
  CameraSnapshot& camera = tick_.cameras[source.camera];
  switch (source.stream) {
    case Stream::kObservation:
      observation_ = decodeObservation(payload).observation;
      observation_.camera = cameraId(static_cast<int>(source.camera));
      return Found::kObservation;
    case Stream::kTrack:
      tick_.cameras[cameraBy(source.camera)].track = decodeTrack(payload);
      break;
    case Stream::kExtrinsics:
      decodeExtrinsics(payload, camera.estimate);
      break;
    case Stream::kCameraState:
      decodeCameraState(payload, camera, words_);
      break;
    case Stream::kCameraTruth:
      camera.has_truth = true;
      camera.true_camera_from_world = decodePose(payload).inverse();
      break;
    case Stream::kBelief:
      decodeBelief(payload, beliefs_[source.camera]);
      ++beliefs_taken_[source.camera];
      break;
    default:
      break;
  }
  return Found::kNothing;
}

}  // namespace helical
