#pragma once

#include <string>
#include <string_view>

#include "engine/session/mcap_writer.h"

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
  kCameraTrack,
  kPointCloud,
  kImage,
  kCompressedImage,
};
inline constexpr int kMessageKinds = 15;

/// "geometry_msgs/msg/PoseStamped".
std::string messageName(MessageKind kind);
/// Whether a schema of this name is of images.
bool isImageMessage(std::string_view name);
/// In which chunks messages of this schema are written.
McapWriter::Weight weightOf(std::string_view name);
/// The definition with those of all messages inside it, as schemas of encoding `ros2msg` have it.
std::string messageDefinition(MessageKind kind);

}  // namespace helical
