#pragma once

#include <string>
#include <string_view>

namespace helical {

/// The kinds of messages in a session: ROS 2's own wherever one fits, `helical_msgs` where none does. Names
/// of own fields end in their unit.
enum class MessageKind {
  kPoseStamped,
  kPoseWithCovarianceStamped,
  kTwistStamped,
  kTransforms,
  kCameraInfo,
  kLog,
  kObservation,
  kStickDemand,
  kFlightState,
  kCameraState,
  kOperatorOrder,
};
inline constexpr int kMessageKinds = 11;

/// "geometry_msgs/msg/PoseStamped".
std::string messageName(MessageKind kind);
/// The definition with those of all messages inside it, as schemas of encoding `ros2msg` have it.
std::string messageDefinition(MessageKind kind);

}  // namespace helical
