#include "engine/config/calibration_file.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>

#include "engine/base/error.h"
#include "engine/config/pose_table.h"
#include "engine/config/text_file.h"
#include "engine/config/toml_table.h"

namespace helical {
namespace {

std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char letter : text) {
    if (letter == '"' || letter == '\\') result += '\\';
    result += static_cast<unsigned char>(letter) < 0x20 ? ' ' : letter;
  }
  return result + "\"";
}

/// A whole number would be read as an integer, which is as good; "inf" and "nan" cannot be.
std::string numberToTheLastBit(double value) {
  char number[40];
  std::snprintf(number, sizeof number, "%.17g", value);
  return number;
}

template <class Derived>
std::string listed(const Eigen::DenseBase<Derived>& values) {
  std::string result = "[";
  for (Eigen::Index i = 0; i < values.size(); ++i)
    result += (i > 0 ? ", " : "") + numberToTheLastBit(values.derived().data()[i]);
  return result + "]";
}

SavedCamera readCamera(TomlTable& table) {
  SavedCamera camera;
  camera.label = table.required("id", table.textOrInteger("id"), std::string("1"), "id = 1");
  camera.method = table.text("method").value_or("given");
  camera.focal_scale = table.number("focal_scale").value_or(1.0);
  if (!(camera.focal_scale > 0.5 && camera.focal_scale < 2.0))
    table.fail("focal_scale", "no refinement finds such a focal length", "give 0.5 to 2");
  const auto covariance = readCovariance(table);
  if (covariance) camera.covariance = *covariance;
  camera.camera_from_world = readPose(table);
  return camera;
}

}  // namespace

SavedCalibration parseCalibration(std::string_view toml, const std::string& name) {
  TomlTable root = TomlTable::parse(toml, name);
  SavedCalibration calibration;
  const int version =
      root.required("format_version", root.integer("format_version"), 1, "format_version = 1");
  TomlTable provenance = root.table("provenance");
  calibration.rig = provenance.text("rig").value_or("");
  calibration.written = provenance.text("written").value_or("");
  calibration.after_s = provenance.number("after_s").value_or(0.0);
  provenance.finish();
  calibration.markers_in_body = root.points("markers_m").value_or(std::vector<Eigen::Vector3d>());
  for (TomlTable& table : root.tables("camera")) {
    calibration.cameras.push_back(readCamera(table));
    const auto same = std::count_if(
        calibration.cameras.begin(), calibration.cameras.end(),
        [&](const SavedCamera& other) { return other.label == calibration.cameras.back().label; });
    if (same > 1) table.fail("id", "two cameras have this id", "keep one of them");
  }
  root.finish();
  if (version != 1)
    root.fail("format_version", "a calibration of another format than 1", "use one of format_version 1");
  if (calibration.cameras.empty())
    root.fail("camera", "the calibration has no camera", "give a file that `helical fly --save-calibration` wrote");
  return calibration;
}

SavedCalibration loadCalibration(const std::filesystem::path& file) {
  return parseCalibration(readTextFile(file, "calibration"), file.string());
}

std::string toToml(const SavedCalibration& calibration) {
  char after[40];
  std::snprintf(after, sizeof after, "%.3f", calibration.after_s);
  std::string text = "# Where cameras stand: camera_from_world, and the covariance of its error (rotation in the\n"
                     "# camera's frame [rad], then the camera's centre in the world [m]).\nformat_version = 1\n";
  if (!calibration.markers_in_body.empty()) {
    text += "markers_m = [";
    for (std::size_t i = 0; i < calibration.markers_in_body.size(); ++i)
      text += (i > 0 ? ", " : "") + listed(calibration.markers_in_body[i]);
    text += "]\n";
  }
  text += "\n[provenance]\nrig = " + quoted(calibration.rig) + "\nwritten = " + quoted(calibration.written) +
          "\nafter_s = " + after + "\n";
  for (const SavedCamera& camera : calibration.cameras) {
    const Eigen::Quaterniond& q = camera.camera_from_world.rotation;
    text += "\n[[camera]]\nid = " + quoted(camera.label) + "\nmethod = " + quoted(camera.method) +
            "\nrotation_wxyz = " + listed(Eigen::Vector4d(q.w(), q.x(), q.y(), q.z())) +
            "\ntranslation_m = " + listed(camera.camera_from_world.translation) +
            "\ncovariance = " + listed(camera.covariance) + "\n";
    if (camera.focal_scale != 1.0) text += "focal_scale = " + numberToTheLastBit(camera.focal_scale) + "\n";
  }
  return text;
}

void saveCalibration(const std::filesystem::path& file, const SavedCalibration& calibration) {
  const std::filesystem::path beside = file.string() + ".part";
  std::ofstream out(beside, std::ios::binary | std::ios::trunc);
  out << toToml(calibration);
  out.close();
  std::error_code refused;
  if (out) std::filesystem::rename(beside, file, refused);
  if (!out || refused) {
    const std::string why = refused ? refused.message() : std::strerror(errno);
    std::filesystem::remove(beside, refused);
    throw Error(ErrorKind::kSystem, "the calibration cannot be written: " + why, file.string(),
                "check the folder and the disk");
  }
}

}  // namespace helical
