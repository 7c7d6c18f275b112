#include <CLI/CLI.hpp>
#include <charconv>
#include <memory>

#include "app/calibrate.h"
#include "engine/base/error.h"
#include "engine/base/log.h"
#include "engine/calibration/intrinsics/camera_exchange.h"
#include "engine/config/rig_file.h"
#include "engine/config/rig_writer.h"
#include "engine/config/text_file.h"

namespace helical {
namespace {

struct ConvertArguments {
  std::string in;
  std::string out;
  std::string to;
  std::string camera;
  std::string size;
};

std::optional<ImageSize> parseSize(const std::string& text) {
  if (text.empty()) return std::nullopt;
  ImageSize size;
  const char* const end = text.data() + text.size();
  const auto first = std::from_chars(text.data(), end, size.width);
  const bool by = first.ec == std::errc() && first.ptr != end && *first.ptr == 'x';
  const auto second = by ? std::from_chars(first.ptr + 1, end, size.height) : first;
  if (!by || second.ec != std::errc() || second.ptr != end || size.width < 1 || size.height < 1 ||
      size.width > 16384 || size.height > 16384)
    throw Error(ErrorKind::kInput, "\"" + text + "\" is no image size", "--size", "give it as in 640x480");
  return size;
}

bool isRig(const std::string& file) {
  return std::filesystem::path(file).extension() == ".toml";
}

std::vector<ExchangedCamera> readAny(const ConvertArguments& arguments) {
  if (!isRig(arguments.in))
    return readCameras(readTextFile(arguments.in, "camera file"), arguments.in, parseSize(arguments.size));
  std::vector<ExchangedCamera> cameras;
  for (const CameraConfig& c : loadRig(arguments.in).cameras)
    cameras.push_back({c.label, c.model, c.pose_is_guess ? std::nullopt : c.camera_from_world});
  return cameras;
}

void choose(const std::string& label, std::vector<ExchangedCamera>& cameras) {
  if (label.empty()) return;
  std::string known;
  for (const ExchangedCamera& c : cameras) known += (known.empty() ? "" : ", ") + c.label;
  std::erase_if(cameras, [&](const ExchangedCamera& c) { return c.label != label; });
  if (cameras.empty())
    throw Error(ErrorKind::kInput, "there is no camera '" + label + "'", "--camera", "use one of " + known);
}

std::string written(const ConvertArguments& arguments, const std::vector<ExchangedCamera>& cameras) {
  if (arguments.to == "opencv") return writeCameras(cameras, CameraFormat::kOpenCv);
  if (arguments.to == "kalibr") return writeCameras(cameras, CameraFormat::kKalibr);
  if (arguments.to == "ros") return writeCameras(cameras, CameraFormat::kRos);
  std::vector<WrittenCamera> rig;
  for (const ExchangedCamera& c : cameras) rig.push_back({c.label, c.model, c.camera_from_world});
  return rigOfCameras(rig, "Converted by helical calibrate convert from " +
                               std::filesystem::path(arguments.in).filename().string() + ".");
}

int convert(ConvertArguments arguments) {
  if (arguments.to.empty() && isRig(arguments.out)) arguments.to = "rig";
  if (arguments.to.empty())
    throw Error(ErrorKind::kInput, "which format to write is not said", "--to",
                "give rig, opencv, kalibr or ros");
  std::vector<ExchangedCamera> cameras = readAny(arguments);
  choose(arguments.camera, cameras);
  writeTextFile(arguments.out, written(arguments, cameras));
  log(LogLevel::kInfo, std::to_string(cameras.size()) + " cameras written to " + arguments.out);
  return 0;
}

}  // namespace

void addCalibrateConvertCommand(CLI::App& calibrate_command, int& exit_code) {
  auto arguments = std::make_shared<ConvertArguments>();
  CLI::App* command = calibrate_command.add_subcommand(
      "convert", "Cameras from and to OpenCV YAML, Kalibr camchain and ROS camera_info");
  command->add_option("in", arguments->in, "Rig file (.toml), or any of the others")->required();
  command->add_option("out", arguments->out, "File to write")->required();
  command->add_option("--to", arguments->to, "Format of it: rig (as .toml files are), opencv, kalibr, ros")
      ->check(CLI::IsMember({"rig", "opencv", "kalibr", "ros"}));
  command->add_option("--camera", arguments->camera, "This camera only");
  command->add_option("--size", arguments->size, "Image size of files that do not tell it: 640x480");
  command->callback([arguments, &exit_code] { exit_code = convert(*arguments); });
}

}  // namespace helical
