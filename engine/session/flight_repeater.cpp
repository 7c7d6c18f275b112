#include "engine/session/flight_repeater.h"

#include <utility>

#include "engine/session/flight_change_text.h"
#include "engine/session/session_writer.h"

namespace helical {

FlightRepeater::FlightRepeater(const McapReader& session, const RigConfig& rig, const ReplayChanges& changes,
                               FlightLoop& loop, Ticker ticker,
                               const std::function<void(const EngineSnapshot&)>& listener, Replay& replay)
    : session_(session),
      rig_(rig),
      changes_(changes),
      loop_(loop),
      ticker_(std::move(ticker)),
      listener_(listener),
      replay_(replay) {
  for (std::size_t i = 0; i < rig_.cameras.size(); ++i) {
    observation_topics_[cameraTopic(rig_, i) + "observation"] = i;
    true_pose_topics_[cameraTopic(rig_, i) + "true_pose"] = i;
  }
}

void FlightRepeater::take(const McapMessage& message) {
  const auto channel = session_.channels().find(message.channel);
  if (channel == session_.channels().end()) return;
  const std::string& topic = channel->second.topic;
  const auto observed = observation_topics_.find(topic);
  const auto placed = true_pose_topics_.find(topic);
  if (observed != observation_topics_.end())
    observe(observed->second, decodeObservation(message.payload));
  else if (placed != true_pose_topics_.end())
    next_.true_camera_from_world[placed->second] = decodePose(message.payload).inverse();
  else if (topic == kOrdersTopic)
    obey(decodeOrder(message.payload));
  else if (topic == kTruePoseTopic)
    truth_.world_from_body = decodePose(message.payload);
  else if (topic == kTrueVelocityTopic)
    decodeVelocity(message.payload, truth_);
  else if (topic == kPoseTopic || topic == kSetPointTopic || topic == kSticksTopic)
    recorded_[topic] = message.payload;
  else if (topic == kFlightStateTopic)
    tick(decodeFlightState(message.payload, state_, words_));
}

void FlightRepeater::observe(std::size_t camera, DecodedObservation decoded) {
  countMissing(decoded.order);
  Observation& observation = decoded.observation;
  observation.camera = cameraId(static_cast<int>(camera));
  for (const Occlusion& occlusion : changes_.occlusions)
    if (occlusion.covers(observation.camera, toSeconds(observation.exposure))) observation.count = 0;
  loop_.onObservation(observation, decoded.used);
}

void FlightRepeater::obey(const DecodedOrder& order) {
  countMissing(order.order);
  if (order.kind == "change") {
    FlightChange change = flightChangeOf(order.method, rig_.control);
    if (change.plan) loop_.swapPlan(*change.plan);
    if (change.control) loop_.setControl(*change.control);
    return;
  }
  if (order.camera < 0 || static_cast<std::size_t>(order.camera) >= rig_.cameras.size()) throw CutShort();
  const CameraId id = cameraId(order.camera);
  if (order.kind == "hide" || order.kind == "show") loop_.hideCamera(id, order.kind == "hide");
  if (order.decided) loop_.orderCalibration(*order.decided);
  if (order.kind != "calibrate") return;
  const std::string& method = changes_.other_calibrator ? rig_.calibrator : order.method;
  replay_.other_methods = replay_.other_methods || method != order.method;
  auto calibration = newCalibration(rig_, id, method, order.seed);
  loop_.swapCalibration(id, calibration);
}

void FlightRepeater::tick(const DecodedTick& decoded) {
  countMissing(decoded.order);
  next_.time = state_.time;
  next_.commands = decoded.commands;
  next_.devices = decoded.devices;
  next_.truth.reset();
  if (state_.has_truth) next_.truth = truth_;
  EngineSnapshot now = ticker_(next_);
  addTruth(now);
  compare(now);
  ++replay_.ticks;
  replay_.score.add(now);
  replay_.last = now;
  listener_(now);
  recorded_.clear();
}

void FlightRepeater::addTruth(EngineSnapshot& now) {
  now.gust_ordered = state_.gust_ordered;
  now.has_truth = state_.has_truth;
  if (!state_.has_truth) return;
  now.truth = truth_;
  now.verdict = state_.verdict;
  if (state_.verdict.crashed && !replay_.crash_reason)
    replay_.crash_reason = std::make_shared<const std::string>(state_.verdict.reason);
  now.verdict.reason = replay_.crash_reason ? replay_.crash_reason->c_str() : "";
  for (std::size_t i = 0; i < next_.true_camera_from_world.size(); ++i) {
    const auto& pose = next_.true_camera_from_world[i];
    if (!pose) continue;
    now.cameras[i].has_truth = true;
    now.cameras[i].true_camera_from_world = *pose;
  }
}

/// Bit for bit: the messages that this tick would have written are those that were.
void FlightRepeater::compare(const EngineSnapshot& now) {
  std::map<std::string, std::string> made;
  CdrWriter out;
  if (now.pose_known) {
    encodeTrackedPose(out, now.tracked);
    made[kPoseTopic] = out.bytes();
  }
  encodeSetPointPose(out, now.time, now.set_point);
  made[kSetPointTopic] = out.bytes();
  encodeSticks(out, now.time, now.sticks);
  made[kSticksTopic] = out.bytes();
  const auto pose = recorded_.find(kPoseTopic);
  if (pose != recorded_.end() && now.pose_known)
    replay_.position_difference.add(
        (decodePose(pose->second).translation - now.tracked.state.world_from_body.translation).norm());
  if (made == recorded_) return;
  ++replay_.different_ticks;
  if (replay_.first_difference_s < 0.0) replay_.first_difference_s = toSeconds(now.time);
}

void FlightRepeater::countMissing(std::uint64_t order) {
  if (order > last_order_ + 1) replay_.missing += order - last_order_ - 1;
  last_order_ = order;
}

}  // namespace helical
