#include "engine/config/rig_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "engine/base/error.h"
#include "engine/config/device_table.h"
#include "engine/config/pose_table.h"
#include "engine/config/rig_options.h"
#include "engine/config/text_file.h"
#include "engine/config/toml_table.h"
#include "engine/config/transmitter_table.h"

namespace helical {
namespace {

constexpr int kLargestSide = 16384;
constexpr std::size_t kLongestLabel = 16;

std::string readLabel(TomlTable& table) {
  const std::string label = table.required("id", table.textOrInteger("id"), std::string("1"), "id = 1");
  // Options write cameras as CAM@FROM-TO, CAM,CAM and CAM,CAM=METRES.
  if (label.empty() || label.size() > kLongestLabel ||
      label.find_first_of(" \t\r\n,@:=") != std::string::npos)
    table.fail("id", "'id' is no short word",
               "use 1 to 16 letters and digits, such as id = 1 or id = \"left\"");
  return label;
}

std::string readSource(TomlTable& table) {
  const std::string source = table.text("source").value_or("");
  if (source.empty() || source == "sim") return source;
  for (const char* kind : {"aravis:", "webcam:", "file:"})
    if (source.starts_with(kind) && source != kind) return source;
  table.fail("source", "unknown source '" + source + "'",
             "use source = \"sim\", \"aravis:ADDRESS-OR-SERIAL\", \"webcam:/dev/video0\" or \"file:PATH\"");
}

CameraModel readModel(const TomlTable& camera, const Eigen::Vector2d& size, TomlTable table) {
  const auto required = [&](const char* key, double usual) {
    return table.required(key, table.number(key), usual, std::string(key) + ", in pixels");
  };
  const double fx = required("fx", 1.0), fy = required("fy", 1.0);
  const double cx = required("cx", 0.0), cy = required("cy", 0.0);
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(5);
  const Eigen::VectorXd given = table.numbers("distortion", 5, 8).value_or(none);
  std::array<double, 8> distortion{};
  std::copy(given.begin(), given.end(), distortion.begin());
  table.finish();
  for (const double side : size)
    if (side < 1.0 || side > kLargestSide || side != std::floor(side))
      camera.fail("size", "'size' is no image size",
                  "give width and height in whole pixels, from 1 to 16384");
  for (const auto& [key, focal] : {std::pair("fx", fx), std::pair("fy", fy)})
    if (focal <= 0.0)
      table.fail(key, "'" + std::string(key) + "' is not positive",
                 "give the focal length in pixels, greater than 0");
  return CameraModel(static_cast<int>(size[0]), static_cast<int>(size[1]), fx, fy, cx, cy, distortion);
}

CameraConfig readCamera(TomlTable& table) {
  CameraConfig camera;
  camera.label = readLabel(table);
  camera.name = table.text("name").value_or("Camera " + camera.label);
  camera.source = readSource(table);
  const Eigen::VectorXd vga = Eigen::Vector2d(640, 480);
  const Eigen::VectorXd size = table.required("size", table.numbers("size", 2), vga, "size = [640, 480]");
  camera.ignored_areas = table.polygons("ignored_areas_px").value_or(IgnoredAreas{});
  TomlTable intrinsics = table.table("intrinsics"), pose = table.table("pose"), device = table.table("device");
  table.finish();
  readDeviceOptions(std::move(device), camera.device);
  camera.model = readModel(table, size, std::move(intrinsics));
  if (!table.has("pose")) return camera;
  camera.pose_is_guess = pose.boolean("initial").value_or(false);
  camera.pose_covariance = readCovariance(pose);
  camera.camera_from_world = readPose(pose);
  return camera;
}

void readCameras(TomlTable& root, RigConfig& rig) {
  std::map<std::string, int> lines;
  for (TomlTable& table : root.tables("camera")) {
    rig.cameras.push_back(readCamera(table));
    const std::string& label = rig.cameras.back().label;
    const int line = table.lineOf("id");
    if (const auto [first, is_new] = lines.emplace(label, line); !is_new)
      table.fail("id",
                 "two cameras have the id '" + label + "': lines " + std::to_string(first->second) + " and " +
                     std::to_string(line),
                 "give each camera an id of its own");
  }
}

void checkCameraCount(const TomlTable& root, const RigConfig& rig) {
  if (rig.cameras.empty()) root.fail("camera", "the rig has no camera", "add a [[camera]] table");
  if (rig.cameras.size() > kMaxCameras)
    root.fail("camera", "the rig has " + std::to_string(rig.cameras.size()) + " cameras",
              "keep at most " + std::to_string(kMaxCameras));
}

/// Where a simulated camera truly is when its [camera.pose] does not say so.
void readTruePose(TomlTable table, RigConfig& rig) {
  const std::string label = readLabel(table);
  const RigidTransform pose = readPose(table);
  const auto camera =
      std::find_if(rig.cameras.begin(), rig.cameras.end(), [&](const auto& c) { return c.label == label; });
  if (camera == rig.cameras.end())
    table.fail("id", "there is no camera '" + label + "'", "name a camera by the id of its [[camera]] table");
  auto& truth = rig.simulation.true_camera_from_world[static_cast<std::size_t>(camera - rig.cameras.begin())];
  if (truth) table.fail("id", "camera '" + label + "' has two true poses", "remove one of them");
  if (camera->camera_from_world && !camera->pose_is_guess)
    table.fail("id", "camera '" + label + "' has its true pose in [camera.pose] already",
               "remove this one, or write initial = true in [camera.pose]");
  truth = pose;
}

void readSimulation(TomlTable simulation, RigConfig& rig) {
  rig.simulation.true_camera_from_world.resize(rig.cameras.size());
  for (TomlTable& table : simulation.tables("camera")) readTruePose(std::move(table), rig);
  readSimulationOptions(simulation, rig.simulation);
}

void checkSimulatedCamerasHaveAPlace(const TomlTable& root, const RigConfig& rig) {
  for (std::size_t i = 0; i < rig.cameras.size(); ++i) {
    const CameraConfig& camera = rig.cameras[i];
    const bool placed =
        (camera.camera_from_world && !camera.pose_is_guess) || rig.simulation.true_camera_from_world[i];
    if (camera.source == "sim" && !placed)
      root.fail("camera", "the simulated camera '" + camera.label + "' has no true pose",
                "add [camera.pose], or [[simulation.camera]] with id, rotation_wxyz and translation_m");
  }
}

}  // namespace

RigConfig parseRig(std::string_view toml, const std::string& name) {
  TomlTable root = TomlTable::parse(toml, name);
  RigConfig rig;
  rig.path = name;
  const int version =
      root.required("format_version", root.integer("format_version"), 1, "format_version = 1");
  if (version != 1)
    root.fail("format_version", "a rig of another format than 1", "use a rig of format_version 1");
  readCameras(root, rig);
  readHelicopter(root.table("helicopter"), rig);
  readMarkerOptions(root.table("markers"), rig.marker_options);
  readTrackerOptions(root.table("tracking"), rig.tracking);
  readControllerOptions(root.table("flight"), rig.control);
  readSupervisorOptions(root.table("safety"), rig.safety);
  readTransmitterOptions(root.table("transmitter"), rig.transmitter);
  readCalibration(root.table("calibration"), rig);
  readSimulation(root.table("simulation"), rig);
  root.finish();
  checkCameraCount(root, rig);
  checkSimulatedCamerasHaveAPlace(root, rig);
  return rig;
}

RigConfig loadRig(const std::filesystem::path& file) {
  return parseRig(readTextFile(file, "rig file"), file.string());
}

}  // namespace helical
