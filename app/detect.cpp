#include "app/detect.h"

#include <CLI/CLI.hpp>
#include <charconv>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "app/centroid_csv.h"
#include "app/progress.h"
#include "engine/base/error.h"
#include "engine/base/log.h"
#include "engine/cameras/file/media_reader.h"
#include "engine/config/rig_file.h"
#include "engine/markers/extractor.h"

namespace helical {
namespace {

struct DetectArguments {
  std::string media;
  std::string background;
  std::string rig;
  std::string camera;
  std::string hsv;
  std::string csv;
};

std::string sizeName(int width, int height) {
  return std::to_string(width) + "x" + std::to_string(height);
}

/// Reads "LOW-HIGH" from the front of `text` and removes it together with one comma; false if it is not
/// there.
bool takeRange(std::string_view& text, int& low, int& high) {
  const auto take = [&text](int& value) {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc()) return false;
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    return true;
  };
  if (text.starts_with('-') || !take(low) || !text.starts_with('-')) return false;
  text.remove_prefix(1);
  if (text.starts_with('-') || !take(high)) return false;
  if (text.starts_with(',') && text.size() > 1) text.remove_prefix(1);
  return true;
}

void setColourRange(const std::string& hsv, MarkerOptions& options) {
  std::string_view rest = hsv;
  if (takeRange(rest, options.hue_low, options.hue_high) &&
      takeRange(rest, options.saturation_low, options.saturation_high) &&
      takeRange(rest, options.value_low, options.value_high) && rest.empty())
    return;
  throw Error(ErrorKind::kInput, "\"" + hsv + "\" is no colour range", "--hsv",
              "give hue (0-179), saturation and value (0-255) as in 40-80,90-255,40-255");
}

/// Marker options, and the size that frames must have, if the rig tells.
struct Configured {
  MarkerOptions options;
  std::optional<CameraModel> camera;
};

Configured configure(const DetectArguments& arguments) {
  Configured configured;
  if (!arguments.rig.empty()) {
    const RigConfig rig = loadRig(arguments.rig);
    configured.options = rig.marker_options;
    configured.camera = rig.cameras[static_cast<std::size_t>(rig.camera(arguments.camera).index())].model;
  }
  if (!arguments.hsv.empty()) setColourRange(arguments.hsv, configured.options);
  validate(configured.options);
  return configured;
}

void checkSize(const ImageView& image, int width, int height, const std::string& file,
               const std::string& other) {
  if (image.width == width && image.height == height) return;
  throw Error(ErrorKind::kInput,
              "the image has " + sizeName(image.width, image.height) + " pixels, " + other + " " +
                  sizeName(width, height),
              file, "give files of one camera");
}

int detect(const DetectArguments& arguments) {
  const Configured configured = configure(arguments);
  const auto reader = MediaReader::open(arguments.media);
  Extractor extractor(configured.options);
  extractor.disableBackground();
  MediaFrame background;
  if (!arguments.background.empty()) {
    background = readImage(arguments.background);
    extractor.setBackground(background.bgr);
  }

  CentroidCsv csv(arguments.csv);
  MediaFrame frame;
  Observation found;
  int frames = 0, frames_with_markers = 0;
  {
    Progress progress("Detecting markers");
    for (; reader->next(frame); ++frames) {
      if (frame.index == 0) {
        if (configured.camera)
          checkSize(frame.bgr, configured.camera->width(), configured.camera->height(), arguments.media,
                    "camera " + arguments.camera);
        if (background.bgr.data != nullptr)
          checkSize(background.bgr, frame.bgr.width, frame.bgr.height, arguments.background, arguments.media);
      }
      extractor.extract(frame.bgr, found);
      csv.add(frame.index, frame.time_s, found);
      frames_with_markers += found.count > 0 ? 1 : 0;
      if (reader->frameCount() > 0)
        progress.update(static_cast<double>(frames) / reader->frameCount(),
                        "frame " + std::to_string(frames));
    }
  }
  csv.finish();
  log(LogLevel::kInfo, "markers in " + std::to_string(frames_with_markers) + " of " + std::to_string(frames) +
                           " frames; written to " + arguments.csv);
  return 0;
}

}  // namespace

void addDetectCommand(CLI::App& app, int& exit_code) {
  auto arguments = std::make_shared<DetectArguments>();
  CLI::App* command =
      app.add_subcommand("detect", "Find the markers in an image, a video or a folder of images");
  command->add_option("media", arguments->media, "Image, video, or folder of images")->required();
  command->add_option("--background", arguments->background,
                      "Image of the empty field; without it: colour alone");
  CLI::Option* rig = command->add_option("--rig", arguments->rig, "Rig file, for its marker options");
  CLI::Option* camera =
      command->add_option("--camera", arguments->camera, "Which of the rig's cameras took the media");
  rig->needs(camera);
  camera->needs(rig);
  command->add_option("--hsv", arguments->hsv,
                      "Marker colour H0-H1,S0-S1,V0-V1; hue 0-179, the others 0-255");
  command
      ->add_option("--csv", arguments->csv,
                   "File to write: frame,time_s,marker,u_px,v_px,radius_px,area_px,sigma_px "
                   "(time_s is empty for a folder of images)")
      ->required();
  command->callback([arguments, &exit_code] { exit_code = detect(*arguments); });
}

}  // namespace helical
