#include "engine/session/message_types.h"

#include <algorithm>
#include <iterator>
#include <sstream>
#include <vector>

#include "engine/base/check.h"

namespace helical {
namespace {

struct Definition {
  std::string_view name;
  std::string_view text;
};

constexpr Definition kDefinitions[] = {
    {"builtin_interfaces/Time", "int32 sec\nuint32 nanosec\n"},
    {"std_msgs/Header", "builtin_interfaces/Time stamp\nstring frame_id\n"},
    {"geometry_msgs/Point", "float64 x\nfloat64 y\nfloat64 z\n"},
    {"geometry_msgs/Vector3", "float64 x\nfloat64 y\nfloat64 z\n"},
    {"geometry_msgs/Quaternion", "float64 x\nfloat64 y\nfloat64 z\nfloat64 w\n"},
    {"geometry_msgs/Pose", "geometry_msgs/Point position\ngeometry_msgs/Quaternion orientation\n"},
    {"geometry_msgs/PoseStamped", "std_msgs/Header header\ngeometry_msgs/Pose pose\n"},
    {"geometry_msgs/PoseWithCovariance", "geometry_msgs/Pose pose\nfloat64[36] covariance\n"},
    {"geometry_msgs/PoseWithCovarianceStamped",
     "std_msgs/Header header\ngeometry_msgs/PoseWithCovariance pose\n"},
    {"geometry_msgs/Twist", "geometry_msgs/Vector3 linear\ngeometry_msgs/Vector3 angular\n"},
    {"geometry_msgs/TwistStamped", "std_msgs/Header header\ngeometry_msgs/Twist twist\n"},
    {"geometry_msgs/Transform", "geometry_msgs/Vector3 translation\ngeometry_msgs/Quaternion rotation\n"},
    {"geometry_msgs/TransformStamped",
     "std_msgs/Header header\nstring child_frame_id\ngeometry_msgs/Transform transform\n"},
    {"tf2_msgs/TFMessage", "geometry_msgs/TransformStamped[] transforms\n"},
    {"sensor_msgs/RegionOfInterest",
     "uint32 x_offset\nuint32 y_offset\nuint32 height\nuint32 width\nbool do_rectify\n"},
    {"sensor_msgs/CameraInfo",
     "std_msgs/Header header\nuint32 height\nuint32 width\nstring distortion_model\nfloat64[] d\n"
     "float64[9] k\nfloat64[9] r\nfloat64[12] p\nuint32 binning_x\nuint32 binning_y\n"
     "sensor_msgs/RegionOfInterest roi\n"},
    {"sensor_msgs/Image",
     "std_msgs/Header header\nuint32 height\nuint32 width\nstring encoding\nuint8 is_bigendian\n"
     "uint32 step\nuint8[] data\n"},
    {"sensor_msgs/CompressedImage", "std_msgs/Header header\nstring format\nuint8[] data\n"},
    {"sensor_msgs/PointField",
     "uint8 INT8=1\nuint8 UINT8=2\nuint8 INT16=3\nuint8 UINT16=4\nuint8 INT32=5\nuint8 UINT32=6\n"
     "uint8 FLOAT32=7\nuint8 FLOAT64=8\nstring name\nuint32 offset\nuint8 datatype\nuint32 count\n"},
    {"sensor_msgs/PointCloud2",
     "std_msgs/Header header\nuint32 height\nuint32 width\nsensor_msgs/PointField[] fields\n"
     "bool is_bigendian\nuint32 point_step\nuint32 row_step\nuint8[] data\nbool is_dense\n"},
    {"rcl_interfaces/Log",
     "byte DEBUG=10\nbyte INFO=20\nbyte WARN=30\nbyte ERROR=40\nbyte FATAL=50\n"
     "builtin_interfaces/Time stamp\nuint8 level\nstring name\nstring msg\nstring file\nstring function\n"
     "uint32 line\n"},
    {"helical_msgs/Centroid",
     "float64 u_px\nfloat64 v_px\nfloat64[4] covariance_px2\nfloat64 area_px2\nfloat64 radius_px\n"
     "int32 colour\n"
     "int32 marker            # counted from 0; -1: no marker was seen in it\n"
     "bool selected           # used for the pose\n"
     "bool predicted          # the next two are valid\n"
     "float64 reprojected_u_px\nfloat64 reprojected_v_px\n"},
    {"helical_msgs/Observation",
     "std_msgs/Header header  # mid-exposure\n"
     "uint64 order            # of what reached the flight thread\n"
     "int64 used_ns\nuint64 sequence\nint64 exposure_ns\nint64 arrival_ns\nint64 extraction_ns\n"
     "bool truncated\nhelical_msgs/Centroid[] centroids\n"},
    {"helical_msgs/MarkerTrack",
     "bool observed           # a centroid was named after it\n"
     "bool agrees             # and lay where it was predicted\n"
     "bool selected           # and was used for the pose\n"
     "bool predicted          # the last two are valid\n"
     "float64 u_px\nfloat64 v_px\nfloat64 reprojected_u_px\nfloat64 reprojected_v_px\n"},
    {"helical_msgs/CameraTrack",
     "std_msgs/Header header  # mid-exposure\n"
     "int32 predicted_count   # balls that should be in the image\n"
     "int32 agreeing_count\nint32 selected_count\nfloat64 residual_px\n"
     "helical_msgs/MarkerTrack[] markers\n"},
    {"helical_msgs/StickDemand",
     "std_msgs/Header header\nfloat64 upper_rotor\nfloat64 lower_rotor\nfloat64 roll\nfloat64 pitch\n"},
    {"helical_msgs/FlightState",
     "std_msgs/Header header\n"
     "uint64 order            # of what reached the flight thread\n"
     "int64 time_ns\nuint64 tick\nbool arm_ordered\nbool disarm_ordered\nbool take_off_ordered\n"
     "bool hold_ordered\nbool land_ordered\nbool kill_ordered\n"
     "uint8 phase\nstring phase_name\nuint8 safety\nstring safety_name\n"
     "uint32 failsafes        # bits, that have ever acted\n"
     "uint32 alarms           # bits of failsafes and warnings that act now\n"
     "bool armed\n"
     "uint32 failing_checks   # bits of what forbids to arm\n"
     "uint32 arm_refused      # bits of what forbade it at this tick\n"
     "bool holding\n"
     "bool transmitter_present\nbool transmitter_self_test_passed\nbool transmitter_channels_calibrated\n"
     "bool transmitter_fault\nbool pilot_flies\nbool bench\n"
     "bool recording\nbool record_cut_off\nbool record_stalled\nuint64 record_lost\n"
     "uint64 record_lost_images\nfloat64 disk_free_gb\n"
     "bool pose_known\nint64 pose_age_ns\nbool hovering\nfloat64 flight_time_s\nfloat64 pad_height_m\n"
     "int64 server_p50_ns\nint64 server_p99_ns\nint64 frame_to_command_p50_ns\n"
     "int64 frame_to_command_p99_ns\nfloat64 tick_rate_hz\n"
     "string obstacle         # why it could not take off now\n"
     "string refusal          # why a take-off order was given up, at that tick\n"
     "bool gust_ordered\n"
     "bool has_truth          # the others are valid; simulated flights\n"
     "bool crashed\nstring crash_reason\nfloat64 crash_time_s\nbool has_flown\nbool at_rest\n"
     "float64 hardest_touch_m_s\n"
     "uint32 plans            # changes of the plan so far\n"
     "uint32 controls         # of gains and trims\n"
     "uint32 colours          # of the markers' colour\n"
     "bool cameras_disagree\n"
     "string cold_start       # what the operator has to do while no camera is calibrated\n"
     "uint8[] streams         # of each camera the one, counted from 0, by whose cable its frames come: that one's\n"
     "                        # images, observations and tracks are of this camera\n"},
    {"helical_msgs/CameraState",
     "std_msgs/Header header\nuint8 status\nstring status_name\nbool hidden\n"
     "string calibration_method  # empty: the pose was given\n"
     "float64 effective_sample_size\nint32 boards\nuint32 knocks\nuint64 frames\nuint64 dropped\n"
     "float64 rate_hz\nint64 latency_ns\nint64 extraction_p50_ns\nint64 extraction_p99_ns\n"
     "int32 centroids\nint32 knocks_found\n"
     "bool bound_known        # the Cramer-Rao bound of its calibration is valid\n"
     "float64 bound_position_m\nfloat64 bound_orientation_rad\n"
     "bool frozen             # by the operator: learns no more\n"
     "float64 lost_share      # of its frames, by the operator\n"
     "float64 noise           # the operator's: grey levels, px without images\n"
     "uint32 backgrounds      # taken anew by the operator, so far\n"
     "uint8 link\nuint64 returns\nuint64 resent_packets\nint64 transfer_ns\nfloat64 clock_sigma_s\n"
     "float64 exposure_us     # as the device took it; 0: it does not tell\n"
     "float64 gain            # likewise; not a number: it does not tell\n"
     "bool gain_in_db         # else in the device's own steps\n"
     "string labellings       # the best that its calibration has weighed up, the taken one first; of each the\n"
     "                        # markers of the balls from left to right in the image: 2-0-1-3\n"
     "float32[6] labelling_value  # of each De, from the first guess to its pose in m; not a number: there is none\n"
     "bool labelling_misfit   # it is no distance but the misfit to the frames in standard deviations\n"
     "float64 focal_scale     # of its focal lengths, over the rig's: as a refinement found them\n"},
    {"helical_msgs/OperatorOrder",
     "std_msgs/Header header\n"
     "uint64 order            # of what reached the flight thread\n"
     "int64 time_ns\n"
     "string kind             # hide, show, calibrate, change, freeze, resume, accept, trust-rig, adopt\n"
     "int32 camera            # counted from 0\n"
     "string method           # of a change: its values as JSON\nuint64 seed\n"
     "float64[7] camera_from_world  # of adopt: quaternion w x y z, then the translation\n"
     "float64[36] covariance   # of adopt: rotation in the camera's frame, then its centre in the world\n"
     "float64 focal_scale      # of adopt: of its focal lengths, over the rig's\n"
     "float64 balls_off_m      # of adopt: the farthest of the balls by which the place holds from that flown with\n"},
};

constexpr std::string_view kNames[kMessageKinds] = {
    "geometry_msgs/PoseStamped",  "geometry_msgs/PoseWithCovarianceStamped",
    "geometry_msgs/TwistStamped", "tf2_msgs/TFMessage",
    "sensor_msgs/CameraInfo",     "rcl_interfaces/Log",
    "helical_msgs/Observation",   "helical_msgs/StickDemand",
    "helical_msgs/FlightState",   "helical_msgs/CameraState",
    "helical_msgs/OperatorOrder", "helical_msgs/CameraTrack",
    "sensor_msgs/PointCloud2",    "sensor_msgs/Image",
    "sensor_msgs/CompressedImage"};

const Definition* definitionOf(std::string_view name) {
  const auto* found = std::find_if(std::begin(kDefinitions), std::end(kDefinitions),
                                   [&](const Definition& definition) { return definition.name == name; });
  return found == std::end(kDefinitions) ? nullptr : found;
}

/// The message and all inside it, each once.
void collect(const Definition& definition, std::vector<const Definition*>& all) {
  if (std::find(all.begin(), all.end(), &definition) != all.end()) return;
  all.push_back(&definition);
  std::istringstream lines{std::string(definition.text)};
  for (std::string line; std::getline(lines, line);) {
    const Definition* inside = definitionOf(line.substr(0, line.find_first_of(" [")));
    if (inside != nullptr) collect(*inside, all);
  }
}

}  // namespace

std::string messageName(MessageKind kind) {
  std::string name(kNames[static_cast<std::size_t>(kind)]);
  return name.insert(name.find('/') + 1, "msg/");
}

bool isImageMessage(std::string_view name) {
  return name == messageName(MessageKind::kImage) || name == messageName(MessageKind::kCompressedImage);
}

McapWriter::Weight weightOf(std::string_view name) {
  if (isImageMessage(name)) return McapWriter::Weight::kBulky;
  return name == messageName(MessageKind::kLog) ? McapWriter::Weight::kRare : McapWriter::Weight::kLight;
}

std::string messageDefinition(MessageKind kind) {
  const Definition* outer = definitionOf(kNames[static_cast<std::size_t>(kind)]);
  HELICAL_CHECK(outer != nullptr);
  std::vector<const Definition*> all;
  collect(*outer, all);
  std::string text(outer->text);
  for (std::size_t i = 1; i < all.size(); ++i)
    text += std::string(80, '=') + "\nMSG: " + std::string(all[i]->name) + "\n" + std::string(all[i]->text);
  return text;
}

}  // namespace helical
