#include "engine/session/replay.h"

#include <map>
#include <memory>
#include <string>

#include "engine/base/error.h"
#include "engine/pipeline/flight_loop.h"
#include "engine/session/flight_change_text.h"
#include "engine/session/flight_messages.h"
#include "engine/session/session_writer.h"

namespace helical {
namespace {

/// Goes through a session's messages in their order, drives a flight loop with them, and compares.
class Player {
 public:
  Player(const McapReader& session, const SessionSettings& settings, const ReplayChanges& changes,
         const std::function<void(const EngineSnapshot&)>& listener, Replay& replay)
      : session_(session),
        rig_(settings.rig),
        changes_(changes),
        listener_(listener),
        replay_(replay),
        loop_(settings.rig, settings.plan) {
    for (std::size_t i = 0; i < rig_.cameras.size(); ++i) {
      observation_topics_[cameraTopic(rig_, i) + "observation"] = i;
      true_pose_topics_[cameraTopic(rig_, i) + "true_pose"] = i;
    }
  }

  void take(const McapMessage& message) {
    const auto channel = session_.channels().find(message.channel);
    if (channel == session_.channels().end()) return;
    const std::string& topic = channel->second.topic;
    const auto observed = observation_topics_.find(topic);
    const auto placed = true_pose_topics_.find(topic);
    if (observed != observation_topics_.end())
      observe(observed->second, decodeObservation(message.payload));
    else if (placed != true_pose_topics_.end())
      true_cameras_[placed->second] = decodePose(message.payload).inverse();
    else if (topic == kOrdersTopic)
      obey(decodeOrder(message.payload));
    else if (topic == kTruePoseTopic)
      truth_.world_from_body = decodePose(message.payload);
    else if (topic == kPoseTopic || topic == kSetPointTopic || topic == kSticksTopic)
      recorded_[topic] = message.payload;
    else if (topic == kFlightStateTopic)
      tick(decodeFlightState(message.payload, state_, words_));
  }

 private:
  void observe(std::size_t camera, DecodedObservation decoded) {
    countMissing(decoded.order);
    Observation& observation = decoded.observation;
    observation.camera = cameraId(static_cast<int>(camera));
    for (const Occlusion& occlusion : changes_.occlusions) {
      const double time_s = toSeconds(observation.exposure);
      if (occlusion.camera == observation.camera && time_s >= occlusion.from_s && time_s < occlusion.to_s)
        observation.count = 0;
    }
    loop_.onObservation(observation, decoded.used);
  }

  void obey(const DecodedOrder& order) {
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
    const CameraConfig& camera = rig_.cameras[static_cast<std::size_t>(order.camera)];
    if (order.kind != "calibrate") return;
    const std::string& method = changes_.other_calibrator ? rig_.calibrator : order.method;
    replay_.other_methods = replay_.other_methods || method != order.method;
    auto calibration = std::make_unique<CameraCalibration>(
        method, camera.model, rig_.markers_in_body, camera.camera_from_world, order.seed, rig_.calibration);
    loop_.swapCalibration(id, calibration);
  }

  void tick(const DecodedTick& decoded) {
    countMissing(decoded.order);
    loop_.onTick(state_.time, decoded.commands, decoded.devices);
    EngineSnapshot now = loop_.snapshot();
    addTruth(now);
    compare(now);
    ++replay_.ticks;
    replay_.score.add(now);
    replay_.last = now;
    listener_(now);
    recorded_.clear();
  }

  void addTruth(EngineSnapshot& now) {
    now.gust_ordered = state_.gust_ordered;
    now.has_truth = state_.has_truth;
    if (!state_.has_truth) return;
    now.truth = truth_;
    now.verdict = state_.verdict;
    if (state_.verdict.crashed && !replay_.crash_reason)
      replay_.crash_reason = std::make_shared<const std::string>(state_.verdict.reason);
    now.verdict.reason = replay_.crash_reason ? replay_.crash_reason->c_str() : "";
    for (const auto& [camera, pose] : true_cameras_) {
      now.cameras[camera].has_truth = true;
      now.cameras[camera].true_camera_from_world = pose;
    }
  }

  /// Bit for bit: the messages that this tick would have written are those that were.
  void compare(const EngineSnapshot& now) {
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

  void countMissing(std::uint64_t order) {
    if (order > last_order_ + 1) replay_.missing += order - last_order_ - 1;
    last_order_ = order;
  }

  const McapReader& session_;
  const RigConfig& rig_;
  const ReplayChanges& changes_;
  const std::function<void(const EngineSnapshot&)>& listener_;
  Replay& replay_;
  FlightLoop loop_;
  std::map<std::string, std::size_t> observation_topics_, true_pose_topics_;
  std::map<std::string, std::string> recorded_;  ///< topic to payload, since the last tick
  std::map<std::size_t, RigidTransform> true_cameras_;
  HelicopterState truth_;
  EngineSnapshot state_;  ///< as recorded, with the newest flight state
  Words words_;
  std::uint64_t last_order_ = 0;
};

}  // namespace

Replay replaySession(McapReader& session, const SessionSettings& settings, const ReplayChanges& changes,
                     const std::function<void(const EngineSnapshot&)>& listener) {
  Replay replay;
  Player player(session, settings, changes, listener, replay);
  replay.damaged_chunks =
      session.read(withoutImages(session), [&](const McapMessage& message) { player.take(message); })
          .damaged_chunks;
  if (replay.ticks == 0)
    throw Error(ErrorKind::kInput, "the session ends before the flight's first moment",
                session.file().string(), "give a longer one");
  return replay;
}

}  // namespace helical
