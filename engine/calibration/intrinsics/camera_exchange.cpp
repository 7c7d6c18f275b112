#include "engine/calibration/intrinsics/camera_exchange.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "engine/base/error.h"
#include "engine/calibration/intrinsics/yaml_node.h"

namespace helical {
namespace {

constexpr int kLargestSide = 16384;

/// Reads the fields of one camera; every mistake names the file and the line.
class CameraReader {
 public:
  CameraReader(const YamlNode& node, std::string name) : node_(node), name_(std::move(name)) {}

  [[noreturn]] void fail(const YamlNode& at, const std::string& what, const std::string& cure) const {
    throw Error(ErrorKind::kInput, what, name_ + ":" + std::to_string(std::max(1, at.line)), cure);
  }

  const YamlNode* any(std::initializer_list<const char*> keys) const {
    for (const char* key : keys)
      if (const YamlNode* found = node_.find(key)) return found;
    return nullptr;
  }

  /// Numbers under one of these keys: a sequence, or a matrix with rows, cols and data.
  std::vector<double> numbers(std::initializer_list<const char*> keys, std::size_t fewest,
                              std::size_t most) const {
    const YamlNode* found = any(keys);
    const std::string key = *keys.begin();
    if (found == nullptr) fail(node_, "'" + key + "' is missing", "give a whole camera file");
    const YamlNode* data = found->find("data");
    const auto values = (data != nullptr ? data : found)->numbers();
    if (!values || values->size() < fewest || values->size() > most)
      fail(*found,
           "'" + key + "' does not hold " + std::to_string(fewest) + (most > fewest ? " or more" : "") +
               " numbers",
           "give a whole camera file");
    return *values;
  }

  std::string text(const char* key) const {
    const YamlNode* found = node_.find(key);
    return found != nullptr ? found->scalar : std::string();
  }

  ImageSize size(const std::optional<ImageSize>& given) const {
    const YamlNode *width = any({"image_width", "width"}), *height = any({"image_height", "height"});
    if (const YamlNode* both = node_.find("resolution"); both != nullptr && both->items.size() == 2)
      width = &both->items[0], height = &both->items[1];
    if (width == nullptr || height == nullptr) {
      if (given) return *given;
      fail(node_, "the image size is missing", "give it with --size, as in --size 640x480");
    }
    const double w = width->number().value_or(0.0), h = height->number().value_or(0.0);
    if (!(w >= 1.0 && h >= 1.0 && w <= kLargestSide && h <= kLargestSide && w == std::floor(w) &&
          h == std::floor(h)))
      fail(*width, "this is no image size", "give whole pixels, from 1 to 16384");
    return {static_cast<int>(w), static_cast<int>(h)};
  }

  CameraModel model(const ImageSize& size, double fx, double fy, double cx, double cy,
                    const std::vector<double>& coefficients) const {
    if (!(fx > 0.0 && fy > 0.0)) fail(node_, "a focal length is not positive", "give it in pixels");
    if (std::any_of(coefficients.begin() + std::min<std::ptrdiff_t>(8, std::ssize(coefficients)),
                    coefficients.end(), [](double k) { return k != 0.0; }))
      fail(node_, "the thin-prism or tilted distortion model is not supported",
           "calibrate with eight coefficients");
    std::array<double, 8> distortion{};
    std::copy_n(coefficients.begin(), std::min<std::size_t>(8, coefficients.size()), distortion.begin());
    return CameraModel(size.width, size.height, fx, fy, cx, cy, distortion);
  }

 private:
  const YamlNode& node_;
  std::string name_;
};

ExchangedCamera readKalibrCamera(const YamlNode& node, const std::string& name, const std::string& label,
                                 const std::optional<ImageSize>& size) {
  const CameraReader reader(node, name);
  if (reader.text("camera_model") != "pinhole")
    reader.fail(node, "the camera model '" + reader.text("camera_model") + "' is not supported",
                "calibrate as pinhole-radtan");
  const std::string distortion = reader.text("distortion_model");
  if (distortion != "radtan" && distortion != "none")
    reader.fail(node, "the distortion model '" + distortion + "' is not supported",
                "calibrate as pinhole-radtan");
  const auto k = reader.numbers({"intrinsics"}, 4, 4);
  const auto d = distortion == "none" ? std::vector<double>{} : reader.numbers({"distortion_coeffs"}, 4, 4);
  return {label, reader.model(reader.size(size), k[0], k[1], k[2], k[3], d), std::nullopt};
}

/// cam0 is the world; cam n's T_cn_cnm1 takes points of camera n-1 to camera n.
std::vector<ExchangedCamera> readKalibr(const YamlNode& root, const std::string& name,
                                        const std::optional<ImageSize>& size) {
  std::vector<ExchangedCamera> cameras;
  for (int i = 0; const YamlNode* node = root.find("cam" + std::to_string(i)); ++i) {
    cameras.push_back(readKalibrCamera(*node, name, std::to_string(i), size));
    const CameraReader reader(*node, name);
    if (node->find("T_cn_cnm1") == nullptr || i == 0) continue;
    if (i == 1) cameras[0].camera_from_world = RigidTransform{};
    if (!cameras[static_cast<std::size_t>(i) - 1].camera_from_world) continue;
    const auto values = reader.numbers({"T_cn_cnm1"}, 16, 16);
    const Eigen::Matrix4d t = Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(values.data());
    const Eigen::Matrix3d rotation = t.topLeftCorner<3, 3>();
    if ((rotation * rotation.transpose() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() > 1e-3 ||
        rotation.determinant() < 0.0)
      reader.fail(*node->find("T_cn_cnm1"), "this is no rigid transform", "give the file as Kalibr wrote it");
    const RigidTransform step{Eigen::Quaterniond(rotation).normalized(), t.topRightCorner<3, 1>()};
    cameras.back().camera_from_world = step * *cameras[static_cast<std::size_t>(i) - 1].camera_from_world;
  }
  return cameras;
}

ExchangedCamera readMatrixCamera(const YamlNode& root, const std::string& name,
                                 const std::optional<ImageSize>& size) {
  const CameraReader reader(root, name);
  const std::string distortion = reader.text("distortion_model");
  if (!distortion.empty() && distortion != "plumb_bob" && distortion != "rational_polynomial")
    reader.fail(root, "the distortion model '" + distortion + "' is not supported",
                "calibrate as plumb_bob or rational_polynomial");
  const auto k = reader.numbers({"camera_matrix", "K", "k", "M1", "cameraMatrix"}, 9, 9);
  const auto d =
      reader.numbers({"distortion_coefficients", "D", "d", "D1", "distCoeffs", "dist_coeff"}, 0, 14);
  const std::string label = reader.text("camera_name").substr(0, 16);
  const bool usable = !label.empty() && label.find_first_of(" \t,@:=") == std::string::npos;
  return {usable ? label : "1", reader.model(reader.size(size), k[0], k[4], k[2], k[5], d), std::nullopt};
}

std::string list(std::initializer_list<double> values) {
  std::string text;
  char number[40];
  for (const double value : values) {
    std::snprintf(number, sizeof number, "%.17g", value);
    text += (text.empty() ? "" : ", ") + std::string(number);
  }
  return "[" + text + "]";
}

std::string coefficients(const CameraModel& m) {
  const auto& d = m.distortion();
  return m.rational() ? list({d[0], d[1], d[2], d[3], d[4], d[5], d[6], d[7]})
                      : list({d[0], d[1], d[2], d[3], d[4]});
}

std::string matrix(const std::string& key, const std::string& tag, int rows, int columns,
                   const std::string& data) {
  return key + ":" + tag + "\n  rows: " + std::to_string(rows) + "\n  cols: " + std::to_string(columns) +
         "\n" + (tag.empty() ? "" : "  dt: d\n") + "  data: " + data + "\n";
}

std::string sizeLines(const CameraModel& m) {
  return "image_width: " + std::to_string(m.width()) + "\nimage_height: " + std::to_string(m.height()) + "\n";
}

std::string cameraMatrix(const CameraModel& m) {
  return list({m.fx(), 0, m.cx(), 0, m.fy(), m.cy(), 0, 0, 1});
}

std::string writeOpenCv(const ExchangedCamera& camera) {
  const CameraModel& m = camera.model;
  const std::string tag = " !!opencv-matrix";
  return "%YAML:1.0\n---\n" + sizeLines(m) + matrix("camera_matrix", tag, 3, 3, cameraMatrix(m)) +
         matrix("distortion_coefficients", tag, 1, m.rational() ? 8 : 5, coefficients(m));
}

std::string writeRos(const ExchangedCamera& camera) {
  const CameraModel& m = camera.model;
  return sizeLines(m) + "camera_name: " + camera.label + "\n" +
         matrix("camera_matrix", "", 3, 3, cameraMatrix(m)) +
         "distortion_model: " + (m.rational() ? "rational_polynomial" : "plumb_bob") + "\n" +
         matrix("distortion_coefficients", "", 1, m.rational() ? 8 : 5, coefficients(m)) +
         matrix("rectification_matrix", "", 3, 3, list({1, 0, 0, 0, 1, 0, 0, 0, 1})) +
         matrix("projection_matrix", "", 3, 4,
                list({m.fx(), 0, m.cx(), 0, 0, m.fy(), m.cy(), 0, 0, 0, 1, 0}));
}

std::string writeKalibr(std::span<const ExchangedCamera> cameras) {
  std::string text;
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    const CameraModel& m = cameras[i].model;
    const auto& d = m.distortion();
    if (m.rational() || d[4] != 0.0)
      throw Error(
          ErrorKind::kInput,
          "camera " + cameras[i].label + " has more distortion than Kalibr's radtan holds (k1 k2 p1 p2)", {},
          "use another format");
    text += "cam" + std::to_string(i) +
            ":\n  camera_model: pinhole\n  intrinsics: " + list({m.fx(), m.fy(), m.cx(), m.cy()}) +
            "\n  distortion_model: radtan\n  distortion_coeffs: " + list({d[0], d[1], d[2], d[3]}) +
            "\n  resolution: [" + std::to_string(m.width()) + ", " + std::to_string(m.height()) + "]\n";
    if (i == 0 || !cameras[i].camera_from_world || !cameras[i - 1].camera_from_world) continue;
    const RigidTransform step = *cameras[i].camera_from_world * cameras[i - 1].camera_from_world->inverse();
    const Eigen::Matrix3d r = step.rotation.toRotationMatrix();
    text += "  T_cn_cnm1:\n";
    for (int row = 0; row < 3; ++row)
      text += "  - " + list({r(row, 0), r(row, 1), r(row, 2), step.translation[row]}) + "\n";
    text += "  - [0.0, 0.0, 0.0, 1.0]\n";
  }
  return text;
}

}  // namespace

std::vector<ExchangedCamera> readCameras(std::string_view yaml, const std::string& name,
                                         const std::optional<ImageSize>& size) {
  const YamlNode root = parseYaml(yaml, name);
  if (root.find("cam0") != nullptr) return readKalibr(root, name, size);
  for (const char* key : {"camera_matrix", "K", "k", "M1", "cameraMatrix"})
    if (root.find(key) != nullptr) return {readMatrixCamera(root, name, size)};
  throw Error(ErrorKind::kInput, "there is no camera in it",
              name + ":" + std::to_string(std::max(1, root.line)),
              "give a camera file of OpenCV (camera_matrix), Kalibr (cam0) or ROS (camera_info)");
}

std::string writeCameras(std::span<const ExchangedCamera> cameras, CameraFormat format) {
  if (format == CameraFormat::kKalibr) return writeKalibr(cameras);
  if (cameras.size() != 1)
    throw Error(ErrorKind::kInput,
                "this format holds one camera, and there are " + std::to_string(cameras.size()), {},
                "choose one with --camera");
  return format == CameraFormat::kOpenCv ? writeOpenCv(cameras.front()) : writeRos(cameras.front());
}

}  // namespace helical
