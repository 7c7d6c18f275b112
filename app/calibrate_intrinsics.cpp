#include <CLI/CLI.hpp>
#include <charconv>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <opencv2/imgproc.hpp>

#include "app/calibrate.h"
#include "app/progress.h"
#include "engine/base/error.h"
#include "engine/base/log.h"
#include "engine/calibration/intrinsics/intrinsics_calibration.h"
#include "engine/cameras/file/media_reader.h"
#include "engine/config/rig_writer.h"

namespace helical {
namespace {

constexpr int kFramesOfAVideo = 60;  // neighbouring frames show the same

struct IntrinsicsArguments {
  std::vector<std::string> images;
  std::string board;
  double square_m = 0.0;
  std::string charuco;
  std::string out;
  std::string id = "1";
  bool rational = false;
  bool json = false;
};

void parseSize(const std::string& text, Board& board) {
  const char* const end = text.data() + text.size();
  const auto first = std::from_chars(text.data(), end, board.columns);
  const bool by = first.ec == std::errc() && first.ptr != end && (*first.ptr == 'x' || *first.ptr == 'X');
  const auto second = by ? std::from_chars(first.ptr + 1, end, board.rows) : first;
  if (!by || second.ec != std::errc() || second.ptr != end)
    throw Error(ErrorKind::kInput, "\"" + text + "\" is no board", "--board",
                "count the inner corners as in 9x6 (ChArUco: the squares)");
}

/// "DICT_4X4_50,0.018": dictionary and side of a marker in metres.
void parseCharuco(const std::string& text, Board& board) {
  const auto comma = text.find(',');
  board.dictionary = text.substr(0, comma);
  const char* const start = comma == std::string::npos ? "" : text.c_str() + comma + 1;
  char* end = nullptr;
  board.marker_m = std::strtod(start, &end);
  if (end == start || *end != '\0')
    throw Error(ErrorKind::kInput, "\"" + text + "\" is no ArUco dictionary with a marker size", "--charuco",
                "give both as in DICT_4X4_50,0.018");
}

Board boardOf(const IntrinsicsArguments& arguments) {
  Board board;
  parseSize(arguments.board, board);
  board.square_m = arguments.square_m;
  if (!arguments.charuco.empty()) parseCharuco(arguments.charuco, board);
  validate(board);
  return board;
}

/// What was found in the images.
struct Found {
  std::vector<BoardView> views;
  std::vector<std::string> without;  ///< images without the board
  int width = 0, height = 0;
};

void look(const ImageView& bgr, const std::string& name, const Board& board, Found& found) {
  if (found.width == 0) found.width = bgr.width, found.height = bgr.height;
  if (bgr.width != found.width || bgr.height != found.height)
    throw Error(ErrorKind::kInput,
                "the image has " + std::to_string(bgr.width) + "x" + std::to_string(bgr.height) +
                    " pixels, the first one " + std::to_string(found.width) + "x" +
                    std::to_string(found.height),
                name, "give images of one camera in one resolution");
  cv::Mat gray;
  const cv::Mat colour(bgr.height, bgr.width, CV_8UC3, const_cast<std::uint8_t*>(bgr.data),
                       static_cast<std::size_t>(bgr.stride));
  cv::cvtColor(colour, gray, cv::COLOR_BGR2GRAY);
  BoardView view = findBoard({gray.data, gray.cols, gray.rows, gray.step}, board, name);
  if (view.pixels.empty())
    found.without.push_back(name);
  else
    found.views.push_back(std::move(view));
}

Found findAll(const IntrinsicsArguments& arguments, const Board& board) {
  Found found;
  Progress progress("Looking for the board");
  for (std::size_t i = 0; i < arguments.images.size(); ++i) {
    const auto reader = MediaReader::open(arguments.images[i]);
    const int frames = reader->frameCount();
    const int by = std::max(1, frames / kFramesOfAVideo);
    MediaFrame frame;
    while (reader->next(frame)) {
      if (frame.index % by != 0) continue;
      const std::string name =
          frames == 1 ? arguments.images[i] : arguments.images[i] + " frame " + std::to_string(frame.index);
      look(frame.bgr, name, board, found);
      const double part = frames > 0 ? static_cast<double>(frame.index) / frames : 0.0;
      progress.update((static_cast<double>(i) + part) / static_cast<double>(arguments.images.size()), name);
    }
  }
  return found;
}

nlohmann::json toJson(const IntrinsicsCalibration& c, const Found& found) {
  nlohmann::json views = nlohmann::json::array(), outliers = nlohmann::json::array();
  for (const IntrinsicsView& v : c.views) {
    views.push_back({{"image", v.name}, {"corners", v.corners}, {"rms_px", v.rms_px}, {"used", v.used}});
    if (!v.used) outliers.push_back(v.name);
  }
  const CameraModel& m = c.model;
  const auto count = static_cast<std::ptrdiff_t>(m.rational() ? 8 : 5);
  return {{"verdict", nameOf(c.verdict)},
          {"reasons", c.reasons},
          {"reprojection_rms_px", c.rms_px},
          {"size", {m.width(), m.height()}},
          {"fx", m.fx()},
          {"fy", m.fy()},
          {"cx", m.cx()},
          {"cy", m.cy()},
          {"distortion", std::vector<double>(m.distortion().begin(), m.distortion().begin() + count)},
          {"sigma",
           {{"fx", c.sigma[0]},
            {"fy", c.sigma[1]},
            {"cx", c.sigma[2]},
            {"cy", c.sigma[3]},
            {"distortion", std::vector<double>(c.sigma.begin() + 4, c.sigma.begin() + 4 + count)}}},
          {"tilt_deg", c.tilt_deg},
          {"coverage", c.coverage},
          {"uncovered", c.uncovered},
          {"views", std::move(views)},
          {"outliers", std::move(outliers)},
          {"without_board", found.without}};
}

std::string summary(const IntrinsicsCalibration& c, const Found& found) {
  const CameraModel& m = c.model;
  char text[512];
  const auto used = std::count_if(c.views.begin(), c.views.end(), [](const auto& v) { return v.used; });
  std::snprintf(
      text, sizeof text,
      "Verdict: %s. %.3f px rms over %ld views (%zu left out, %zu images without the board).\n"
      "fx %.2f +- %.2f, fy %.2f +- %.2f, cx %.2f +- %.2f, cy %.2f +- %.2f px (one standard deviation)",
      nameOf(c.verdict), c.rms_px, static_cast<long>(used), c.views.size() - static_cast<std::size_t>(used),
      found.without.size(), m.fx(), c.sigma[0], m.fy(), c.sigma[1], m.cx(), c.sigma[2], m.cy(), c.sigma[3]);
  std::string all = text;
  for (const std::string& reason : c.reasons) all += "\n" + reason;
  return all;
}

void printReport(const IntrinsicsCalibration& c, const Found& found) {
  for (const IntrinsicsView& v : c.views)
    std::printf("%8.3f px  %4d corners  %s%s\n", v.rms_px, v.corners, v.name.c_str(),
                v.used ? "" : "  OUTLIER, left out");
  for (const std::string& name : found.without) std::printf("     no board              %s\n", name.c_str());
  std::printf("corners per part of the image:\n");
  for (std::size_t row = 0; row < 3; ++row)
    std::printf("  %6d %6d %6d\n", c.coverage[3 * row], c.coverage[3 * row + 1], c.coverage[3 * row + 2]);
  const CameraModel& m = c.model;
  for (std::size_t i = 0; i < (m.rational() ? 8U : 5U); ++i) {
    constexpr std::array kNames = {"k1", "k2", "p1", "p2", "k3", "k4", "k5", "k6"};
    std::printf("%s %.5f +- %.5f\n", kNames[i], m.distortion()[i], c.sigma[4 + i]);
  }
  std::printf("%s\n", summary(c, found).c_str());
}

int calibrate(const IntrinsicsArguments& arguments) {
  const Board board = boardOf(arguments);
  const Found found = findAll(arguments, board);
  const IntrinsicsCalibration c =
      calibrateIntrinsics(found.views, found.width, found.height, arguments.rational);
  const bool bad = c.verdict == IntrinsicsVerdict::kBad;
  if (!bad) {
    const WrittenCamera camera{arguments.id, c.model, std::nullopt};
    writeTextFile(arguments.out, rigOfCameras({&camera, 1}, "Intrinsics by helical calibrate intrinsics.\n" +
                                                                summary(c, found)));
  }
  if (arguments.json)
    std::printf("%s\n", toJson(c, found).dump(1).c_str());
  else
    printReport(c, found);
  log(bad ? LogLevel::kError : LogLevel::kInfo,
      bad ? "the calibration is bad: " + arguments.out + " is not written" : "written to " + arguments.out);
  return bad ? 1 : 0;
}

}  // namespace

void addCalibrateIntrinsicsCommand(CLI::App& calibrate_command, int& exit_code) {
  auto arguments = std::make_shared<IntrinsicsArguments>();
  CLI::App* command = calibrate_command.add_subcommand(
      "intrinsics", "Focal length, centre and distortion of one camera from views of a board");
  command->add_option("images", arguments->images, "Images, folders of images, or videos")->required();
  command->add_option("--board", arguments->board, "Inner corners of the chessboard, 9x6; ChArUco: squares")
      ->required();
  command->add_option("--square", arguments->square_m, "Side of a square in metres")->required();
  command->add_option("--charuco", arguments->charuco,
                      "ArUco dictionary and side of a marker in metres: DICT_4X4_50,0.018");
  command->add_option("--out", arguments->out, "Rig file to write, with this one camera")->required();
  command->add_option("--id", arguments->id, "The camera's id in that file")->capture_default_str();
  command->add_flag("--rational", arguments->rational,
                    "Eight distortion coefficients, for wide-angle lenses");
  command->add_flag("--json", arguments->json, "Print one JSON object on stdout");
  command->footer("Verdict: good, usable or bad, and why. A bad calibration is not written (exit code 1).");
  command->callback([arguments, &exit_code] { exit_code = calibrate(*arguments); });
}

}  // namespace helical
