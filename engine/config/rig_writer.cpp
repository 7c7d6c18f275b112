#include "engine/config/rig_writer.h"

#include <toml++/toml.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>

#include "engine/base/error.h"

namespace helical {
namespace {

toml::array numbers(const double* values, std::ptrdiff_t count) {
  toml::array array;
  for (std::ptrdiff_t i = 0; i < count; ++i) array.push_back(values[i]);
  return array;
}

toml::table poseTable(const RigidTransform& pose, const std::optional<Matrix6d>& covariance) {
  const Eigen::Vector4d wxyz(pose.rotation.w(), pose.rotation.x(), pose.rotation.y(), pose.rotation.z());
  toml::table table;
  table.insert("rotation_wxyz", numbers(wxyz.data(), 4));
  table.insert("translation_m", numbers(pose.translation.data(), 3));
  if (covariance) table.insert("covariance", numbers(covariance->data(), 36));
  return table;
}

std::string comment(std::string_view header) {
  std::istringstream lines{std::string(header)};
  std::string text, line;
  while (std::getline(lines, line)) text += line.empty() ? "#\n" : "# " + line + "\n";
  return text + "\n";
}

std::string withComment(std::string_view header, const toml::table& root) {
  std::ostringstream out;
  out << comment(header) << root << '\n';
  return out.str();
}

std::string labelOf(const toml::table& camera) {
  const toml::node* id = camera.get("id");
  if (id == nullptr) return {};
  if (const auto number = id->value_exact<std::int64_t>()) return std::to_string(*number);
  return id->value_or(std::string());
}

/// A number as number: what users most often call their cameras.
void insertLabel(toml::table& camera, const std::string& label) {
  const bool digits = !label.empty() && label.size() < 10 && (label[0] != '0' || label.size() == 1) &&
                      std::all_of(label.begin(), label.end(), [](char c) { return c >= '0' && c <= '9'; });
  if (digits)
    camera.insert("id", static_cast<std::int64_t>(std::stol(label)));
  else
    camera.insert("id", label);
}

void scaleFocalLengths(toml::table& camera, double scale) {
  toml::table* intrinsics = camera["intrinsics"].as_table();
  if (intrinsics == nullptr) return;
  for (const char* key : {"fx", "fy"})
    if (const auto focal = (*intrinsics)[key].value<double>()) intrinsics->insert_or_assign(key, scale * *focal);
}

void moveMarkers(toml::table& root, const std::vector<Eigen::Vector3d>& markers_in_body) {
  toml::array markers;
  for (const Eigen::Vector3d& marker : markers_in_body) markers.push_back(numbers(marker.data(), 3));
  if (!root.contains("helicopter")) root.insert("helicopter", toml::table());
  root["helicopter"].as_table()->insert_or_assign("markers_m", std::move(markers));
}

[[noreturn]] void refuse(const std::filesystem::path& file, int error) {
  const bool mistake = error == ENOENT || error == ENOTDIR || error == EISDIR;
  throw Error(mistake ? ErrorKind::kInput : ErrorKind::kSystem,
              std::string("cannot be written: ") + std::strerror(error), file.string(),
              mistake ? "name a file in a folder that exists" : "see to the disk and your permissions");
}

}  // namespace

std::string rigWithPoses(std::string_view toml, const std::string& name, std::span<const WrittenPose> poses,
                         std::string_view header, const RigCorrections& corrections) {
  toml::table root;
  try {
    root = toml::parse(toml, std::string_view(name));
  } catch (const toml::parse_error& error) {
    throw Error(ErrorKind::kInput, std::string(error.description()),
                name + ":" + std::to_string(error.source().begin.line), "correct the TOML");
  }
  if (toml::array* cameras = root["camera"].as_array())
    for (toml::node& node : *cameras) {
      toml::table* camera = node.as_table();
      if (camera == nullptr) continue;
      const auto pose = std::find_if(poses.begin(), poses.end(),
                                     [&](const auto& p) { return p.label == labelOf(*camera); });
      if (pose != poses.end())
        camera->insert_or_assign("pose", poseTable(pose->camera_from_world, pose->covariance));
      for (const auto& [label, scale] : corrections.focal_scales)
        if (label == labelOf(*camera)) scaleFocalLengths(*camera, scale);
    }
  if (!corrections.markers_in_body.empty()) moveMarkers(root, corrections.markers_in_body);
  return withComment(header, root);
}

std::string rigOfCameras(std::span<const WrittenCamera> cameras, std::string_view header) {
  toml::array array;
  for (const WrittenCamera& camera : cameras) {
    const CameraModel& m = camera.model;
    toml::table table, intrinsics;
    insertLabel(table, camera.label);
    table.insert("size", toml::array{m.width(), m.height()});
    intrinsics.insert("fx", m.fx());
    intrinsics.insert("fy", m.fy());
    intrinsics.insert("cx", m.cx());
    intrinsics.insert("cy", m.cy());
    intrinsics.insert("distortion", numbers(m.distortion().data(), m.rational() ? 8 : 5));
    table.insert("intrinsics", std::move(intrinsics));
    if (camera.camera_from_world) table.insert("pose", poseTable(*camera.camera_from_world, std::nullopt));
    array.push_back(std::move(table));
  }
  toml::table root;
  root.insert("format_version", 1);
  root.insert("camera", std::move(array));
  return withComment(header, root);
}

void writeTextFile(const std::filesystem::path& file, std::string_view text) {
  std::error_code ignored;
  if (std::filesystem::is_directory(file, ignored)) refuse(file, EISDIR);
  // A pipe or a device is no file that another one could take the place of.
  const bool replace =
      !std::filesystem::exists(file, ignored) || std::filesystem::is_regular_file(file, ignored);
  const std::filesystem::path part = replace ? file.string() + ".part" : file.string();
  errno = 0;
  std::ofstream stream(part, std::ios::binary);
  if (stream) stream.write(text.data(), static_cast<std::streamsize>(text.size()));
  stream.close();
  if (stream && replace && std::rename(part.c_str(), file.c_str()) != 0) stream.setstate(std::ios::failbit);
  if (stream) return;
  const int error = errno == 0 ? EIO : errno;
  if (replace) std::filesystem::remove(part, ignored);
  refuse(file, error);
}

}  // namespace helical
