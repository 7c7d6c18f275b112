#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/calibrate.h"
#include "app/progress.h"
#include "engine/base/error.h"
#include "engine/base/log.h"
#include "engine/calibration/rig/rig_calibration.h"
#include "engine/calibration/self_calibration_limits.h"
#include "engine/config/rig_file.h"
#include "engine/config/rig_writer.h"
#include "engine/config/text_file.h"

namespace helical {
namespace {

constexpr double kSamePlaceM = 1e-5;  // of a ball in two files

struct RigArguments {
  std::string observations;
  std::string rig;
  std::string out;
  std::string scale;
  bool trust_stamps = false;
  SelfCalibrationOptions self;
  bool json = false;
};

/// "1,2=1.5": cameras 1 and 2 are 1.5 m apart.
KnownDistance parseScale(const std::string& text, const RigConfig& rig) {
  const auto comma = text.find(','), equals = text.find('=');
  char* end = nullptr;
  const double metres = equals == std::string::npos ? 0.0 : std::strtod(text.c_str() + equals + 1, &end);
  if (comma == std::string::npos || equals == std::string::npos || comma > equals || *end != '\0' ||
      !std::isfinite(metres) || metres <= 0.0)
    throw Error(ErrorKind::kInput, "\"" + text + "\" is no distance of two cameras", "--scale",
                "give two cameras and the metres between them as in 1,2=1.5");
  KnownDistance distance;
  distance.a = static_cast<std::size_t>(rig.camera(text.substr(0, comma)).index());
  distance.b = static_cast<std::size_t>(rig.camera(text.substr(comma + 1, equals - comma - 1)).index());
  distance.metres = metres;
  if (distance.a == distance.b)
    throw Error(ErrorKind::kInput, "a camera has no distance to itself", "--scale", "name two cameras");
  return distance;
}

std::vector<RigCamera> camerasOf(const RigConfig& rig) {
  std::vector<RigCamera> cameras;
  for (const CameraConfig& c : rig.cameras)
    cameras.push_back({c.label, c.model, c.pose_is_guess ? std::nullopt : c.camera_from_world});
  return cameras;
}

nlohmann::json jsonOf(const std::optional<double>& value) {
  return value ? nlohmann::json(*value) : nlohmann::json();
}

nlohmann::json toJson(const RigCalibration& calibration) {
  nlohmann::json cameras = nlohmann::json::array();
  for (const CalibratedCamera& c : calibration.cameras) {
    const bool known = c.covariance.has_value();
    cameras.push_back(
        {{"id", c.label},
         {"placed", c.camera_from_world.has_value()},
         {"given", c.given},
         {"reprojection_rms_px",
          c.observations > c.rejected ? nlohmann::json(c.reprojection_rms_px) : nlohmann::json()},
         {"observations", c.observations},
         {"rejected", c.rejected},
         {"late_s", jsonOf(c.late_s)},
         {"position_sigma_m", known ? nlohmann::json(c.position_sigma_m) : nlohmann::json()},
         {"orientation_sigma_deg", known ? nlohmann::json(c.orientation_sigma_deg) : nlohmann::json()},
         {"distance_m", c.camera_from_world ? nlohmann::json(c.distance_m) : nlohmann::json()},
         {"focal_scale", c.focal_scale},
         {"focal_sigma", jsonOf(c.focal_sigma)}});
  }
  nlohmann::json points = nlohmann::json::array();
  for (const CalibratedPoint& p : calibration.points)
    points.push_back({{"given_m", {p.given.x(), p.given.y(), p.given.z()}},
                      {"found_m", {p.found.x(), p.found.y(), p.found.z()}},
                      {"sigma_m", jsonOf(p.sigma_m)}});
  return {{"verdict", nameOf(calibration.verdict)},
          {"reasons", calibration.reasons},
          {"scale", calibration.metric ? "metric" : "arbitrary"},
          {"scale_from", calibration.scale_from},
          {"world", calibration.world},
          {"target", nameOf(calibration.target)},
          {"timing", calibration.timing == Timing::kTogether ? "together" : "interpolated"},
          {"items", calibration.items},
          {"thinned_by", calibration.thinned_by},
          {"unmatched", calibration.unmatched},
          {"sigma_px", calibration.sigma_px},
          {"points", std::move(points)},
          {"cameras", std::move(cameras)}};
}

std::string sigmaText(std::optional<double> sigma, double factor, const char* unit) {
  if (!sigma) return "sigma not known";
  char text[48];
  std::snprintf(text, sizeof text, "sigma %.3f %s", factor * *sigma, unit);
  return text;
}

void printCorrections(const RigCalibration& calibration) {
  if (calibration.self.focal_sigma > 0.0)
    for (const CalibratedCamera& c : calibration.cameras)
      std::printf("focal length of camera %s: %+.3f %% (%s)\n", c.label.c_str(),
                  100.0 * (c.focal_scale - 1.0), sigmaText(c.focal_sigma, 100.0, "%").c_str());
  double squares = 0.0, farthest = 0.0;
  std::optional<double> sigma = 0.0;
  for (const CalibratedPoint& p : calibration.points) {
    squares += (p.found - p.given).squaredNorm();
    farthest = std::max(farthest, (p.found - p.given).norm());
    sigma = sigma && p.sigma_m ? std::optional(std::max(*sigma, *p.sigma_m)) : std::nullopt;
  }
  const auto count = static_cast<double>(calibration.points.size());
  if (!calibration.points.empty())
    std::printf("points of the body: moved by %.3f mm rms, %.3f mm at most (largest %s)\n",
                1e3 * std::sqrt(squares / count), 1e3 * farthest, sigmaText(sigma, 1e3, "mm").c_str());
}

/// What was found, as far as it is the rig's: a board's points are not.
RigCorrections correctionsOf(const RigCalibration& calibration, const RigConfig& rig) {
  RigCorrections corrections;
  for (const CalibratedCamera& c : calibration.cameras)
    if (c.focal_scale != 1.0) corrections.focal_scales.emplace_back(c.label, c.focal_scale);
  for (const Eigen::Vector3d& ball : rig.markers_in_body.all())
    for (const CalibratedPoint& p : calibration.points)
      if ((p.given - ball).norm() < kSamePlaceM) {
        corrections.markers_in_body.push_back(p.found);
        break;
      }
  if (static_cast<int>(corrections.markers_in_body.size()) != rig.markers_in_body.count())
    corrections.markers_in_body.clear();
  return corrections;
}

/// Against the first placed camera, whose own delay is zero.
void printDelays(const RigCalibration& calibration) {
  if (!calibration.delays) return;
  const auto first = std::find_if(calibration.cameras.begin(), calibration.cameras.end(),
                                  [](const auto& c) { return c.camera_from_world && c.late_s == 0.0; });
  for (const CalibratedCamera& c : calibration.cameras)
    if (c.late_s && *c.late_s != 0.0 && first != calibration.cameras.end())
      std::printf("camera %s saw %.4g s %s than its time stamps say, against camera %s: taken into account\n",
                  c.label.c_str(), std::abs(*c.late_s), *c.late_s > 0.0 ? "later" : "earlier",
                  first->label.c_str());
}

void printReport(const RigCalibration& calibration) {
  std::printf("target: %s, %d %s%s\n", nameOf(calibration.target), calibration.items,
              calibration.target == TargetKind::kBody ? "poses" : "points",
              calibration.timing == Timing::kInterpolated ? ", cameras interpolated to common instants" : "");
  std::printf("scale: %s (from %s); world: %s\n", calibration.metric ? "metric" : "ARBITRARY",
              calibration.scale_from.c_str(), calibration.world.c_str());
  std::printf("%8s %9s %12s %9s %12s %12s\n", "camera", "rms px", "observations", "rejected", "sigma place",
              "sigma angle");
  for (const CalibratedCamera& c : calibration.cameras) {
    std::printf("%8s %9.3f %12ld %9ld", c.label.c_str(), c.reprojection_rms_px, c.observations, c.rejected);
    if (!c.camera_from_world)
      std::printf("  not placed\n");
    else if (!c.covariance)
      std::printf("  %s\n", c.given ? "given" : "open");
    else
      std::printf(calibration.metric ? " %9.2f mm %8.3f deg\n" : " %12.2e %8.3f deg\n",
                  (calibration.metric ? 1e3 : 1.0) * c.position_sigma_m, c.orientation_sigma_deg);
  }
  printDelays(calibration);
  printCorrections(calibration);
  std::printf("verdict: %s\n", nameOf(calibration.verdict));
  for (const std::string& reason : calibration.reasons) std::printf("  %s\n", reason.c_str());
}

std::string decimals(double value, int digits) {
  char text[48];
  std::snprintf(text, sizeof text, "%.*f", digits, value);
  return text;
}

std::string provenance(const RigArguments& arguments, const RigCalibration& calibration) {
  std::string text = "Solved by helical calibrate rig from " +
                     std::filesystem::path(arguments.observations).filename().string() + " and " +
                     std::filesystem::path(arguments.rig).filename().string() +
                     ".\nVerdict: " + nameOf(calibration.verdict) +
                     ". Scale: " + (calibration.metric ? "metric" : "ARBITRARY") + ", from " +
                     calibration.scale_from + ".\nWorld: " + calibration.world +
                     ". A pixel's standard deviation: " + decimals(calibration.sigma_px, 3) + " px per axis.";
  if (calibration.delays) {
    std::string open;
    text += "\nTaken off, how much later than its stamps each camera saw [s]:";
    for (const CalibratedCamera& c : calibration.cameras)
      if (c.late_s)
        text += " " + c.label + " " + decimals(*c.late_s, 4);
      else
        open += " " + c.label;
    text += ".";
    if (!open.empty()) text += " Not known of cameras that could not be placed:" + open + ".";
  }
  if (calibration.self.focal_sigma > 0.0) {
    text += "\nFocal lengths were found, over those of that rig:";
    for (const CalibratedCamera& c : calibration.cameras)
      text += " " + c.label + " " + decimals(c.focal_scale, 5);
    text += ".";
  }
  if (!calibration.points.empty()) text += "\nThe body's points were found, too.";
  for (const std::string& reason : calibration.reasons) text += "\n" + reason;
  return text;
}

void writeRig(const RigArguments& arguments, const RigConfig& rig, const RigCalibration& calibration) {
  std::vector<WrittenPose> poses;
  for (const CalibratedCamera& c : calibration.cameras)
    if (c.camera_from_world && !c.given) poses.push_back({c.label, *c.camera_from_world, c.covariance});
  writeTextFile(arguments.out,
                rigWithPoses(readTextFile(arguments.rig, "rig file"), arguments.rig, poses,
                             provenance(arguments, calibration), correctionsOf(calibration, rig)));
}

int calibrate(const RigArguments& arguments) {
  const RigConfig rig = loadRig(arguments.rig);
  const std::vector<RigCamera> cameras = camerasOf(rig);
  if (cameras.size() < 2)
    throw Error(ErrorKind::kInput, "the rig has one camera", arguments.rig,
                "give a rig of at least two cameras that see the target at once");
  RigCalibrationOptions options;
  if (!arguments.scale.empty()) options.scale = parseScale(arguments.scale, rig);
  options.trust_stamps = arguments.trust_stamps;
  options.self = arguments.self;
  PointRows rows;
  {
    Progress progress("Reading observations");
    rows = readPointRows(arguments.observations, cameras, [&](double done) { progress.update(done); });
  }
  RigCalibration calibration;
  {
    Progress progress("Placing cameras");
    calibration = calibrateRig(cameras, std::move(rows), arguments.observations, options,
                               [&](double done) { progress.update(done); });
  }
  const bool bad = calibration.verdict == RigVerdict::kBad;
  if (!bad) writeRig(arguments, rig, calibration);
  if (arguments.json)
    std::printf("%s\n", toJson(calibration).dump(1).c_str());
  else
    printReport(calibration);
  log(bad ? LogLevel::kError : LogLevel::kInfo,
      bad ? "the calibration is bad: " + arguments.out + " is not written" : "written to " + arguments.out);
  return bad ? 1 : 0;
}

}  // namespace

void addCalibrateRigCommand(CLI::App& calibrate_command, int& exit_code) {
  auto arguments = std::make_shared<RigArguments>();
  CLI::App* command = calibrate_command.add_subcommand(
      "rig",
      "Camera poses from what several cameras saw: a board or the helicopter, named markers, a waved light");
  command
      ->add_option(
          "--observations", arguments->observations,
          "CSV file: time_s,camera,u_px,v_px[,marker][,body_x_m,body_y_m,body_z_m]; columns in any order")
      ->required();
  command
      ->add_option("--rig", arguments->rig, "Rig file with the cameras' intrinsics; poses that it has stand")
      ->required();
  command->add_option("--out", arguments->out, "Rig file to write, with all poses and their covariances")
      ->required();
  command->add_option("--scale", arguments->scale, "Distance of two cameras: CAM,CAM=METRES");
  command->add_flag("--trust-stamps", arguments->trust_stamps,
                    "Seek no delays between cameras: they were triggered together");
  command
      ->add_option(
          "--refine-markers", arguments->self.marker_sigma_m,
          "METRES: the body's points are off its coordinates by about so much per axis: find them, too")
      ->check(CLI::Range(0.0, kMostMarkerSigmaM));
  command
      ->add_option("--refine-focal", arguments->self.focal_sigma,
                   "SHARE: focal lengths are off the rig's by about so much: find them, too")
      ->check(CLI::Range(0.0, kMostFocalSigma));
  command->add_flag("--json", arguments->json, "Print one JSON object on stdout");
  command->footer(
      "Verdict: good, usable or bad, and why. A bad calibration is not written (exit code 1).\n"
      "The scale comes from body coordinates, from two given poses, or from --scale; otherwise it is "
      "arbitrary.\n"
      "Cameras that nothing triggers expose up to a frame apart, whatever their stamps say, and stamps may "
      "be\n"
      "up to a second off: how much later than the first each of them saw is found from how the target "
      "moves,\n"
      "told, and taken into account.\n"
      "Focal lengths that were found go into the rig file, and points that are its balls.");
  command->callback([arguments, &exit_code] { exit_code = calibrate(*arguments); });
}

}  // namespace helical
