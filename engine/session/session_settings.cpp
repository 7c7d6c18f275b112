#include "engine/session/session_settings.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "engine/base/error.h"
#include "engine/config/plan_file.h"
#include "engine/config/rig_file.h"

namespace helical {
namespace {

using nlohmann::json;

constexpr const char* kRigName = "rig.toml";
constexpr const char* kPlanName = "plan.toml";
constexpr const char* kSettingsName = "settings.json";
constexpr int kFormat = 2;

json poseJson(const std::optional<RigidTransform>& pose) {
  if (!pose) return nullptr;
  const Eigen::Quaterniond& q = pose->rotation;
  const Eigen::Vector3d& t = pose->translation;
  return {{"rotation_wxyz", {q.w(), q.x(), q.y(), q.z()}}, {"translation_m", {t.x(), t.y(), t.z()}}};
}

std::optional<RigidTransform> poseOf(const json& value) {
  if (value.is_null()) return {};
  const auto q = value.at("rotation_wxyz").get<std::array<double, 4>>();
  const auto t = value.at("translation_m").get<std::array<double, 3>>();
  return RigidTransform{Eigen::Quaterniond(q[0], q[1], q[2], q[3]), Eigen::Vector3d(t[0], t[1], t[2])};
}

json covarianceJson(const std::optional<Matrix6d>& covariance) {
  if (!covariance) return nullptr;
  return std::vector<double>(covariance->data(), covariance->data() + covariance->size());
}

/// Absent in sessions of the time when there was none.
std::optional<Matrix6d> covarianceOf(const json& camera) {
  if (!camera.contains("covariance") || camera.at("covariance").is_null()) return {};
  return Matrix6d(Eigen::Map<const Matrix6d>(camera.at("covariance").get<std::array<double, 36>>().data()));
}

/// Null where the balls are where the rig file has them.
json markersJson(const RigConfig& rig) {
  if (!rig.simulation.markers_before) return nullptr;
  json balls = json::array();
  for (const Eigen::Vector3d& ball : rig.markers_in_body.all()) balls.push_back({ball.x(), ball.y(), ball.z()});
  return balls;
}

/// All of these are absent in sessions of the time when there was none.
void applySelfCalibration(const json& value, RigConfig& rig) {
  rig.self_calibration.marker_sigma_m = value.value("marker_sigma_m", 0.0);
  rig.self_calibration.focal_sigma = value.value("focal_sigma", 0.0);
  if (!value.contains("markers_m") || value.at("markers_m").is_null()) return;
  std::vector<Eigen::Vector3d> balls;
  for (const auto& ball : value.at("markers_m").get<std::vector<std::array<double, 3>>>())
    balls.emplace_back(ball[0], ball[1], ball[2]);
  rig.replaceMarkers(balls);
}

json camerasJson(const RigConfig& rig) {
  json cameras = json::array();
  const auto& truths = rig.simulation.true_camera_from_world;
  for (std::size_t i = 0; i < rig.cameras.size(); ++i)
    cameras.push_back({{"id", rig.cameras[i].label},
                       {"camera_from_world", poseJson(rig.cameras[i].camera_from_world)},
                       {"initial", rig.cameras[i].pose_is_guess},
                       {"covariance", covarianceJson(rig.cameras[i].pose_covariance)},
                       {"focal_scale", rig.cameras[i].focal_scale},
                       {"true_camera_from_world", i < truths.size() ? poseJson(truths[i]) : json(nullptr)}});
  return cameras;
}

json simulationJson(const SimulationOptions& simulation) {
  json occlusions = json::array(), bumps = json::array();
  for (const auto& occlusion : simulation.occlusions)
    occlusions.push_back(
        {{"camera", occlusion.camera.index()}, {"from_s", occlusion.from_s}, {"to_s", occlusion.to_s}});
  for (const auto& bump : simulation.bumps)
    bumps.push_back({{"camera", bump.camera.index()},
                     {"at_s", bump.at_s},
                     {"angle_rad", bump.angle},
                     {"distance_m", bump.distance},
                     {"across", bump.across}});
  return {{"seed", simulation.seed},
          {"images", simulation.images},
          {"gust_factor", simulation.gust_factor},
          {"vary", simulation.vary},
          {"camera_rate_hz", simulation.camera_rate_hz},
          {"sigma_px", simulation.noise.sigma_px},
          {"lost_markers", simulation.noise.lost_markers},
          {"outliers", simulation.noise.outliers},
          {"marker_error_m", simulation.marker_error_m},
          {"focal_error", simulation.focal_error},
          {"occlusions", occlusions},
          {"bumps", bumps}};
}

CameraId cameraOf(const json& value, const RigConfig& rig) {
  return cameraId(static_cast<int>(std::min(value.get<std::size_t>(), rig.cameras.size() - 1)));
}

void applySimulation(const json& value, RigConfig& rig) {
  SimulationOptions& simulation = rig.simulation;
  simulation.seed = value.at("seed").get<std::uint64_t>();
  simulation.images = value.at("images").get<bool>();
  simulation.gust_factor = value.at("gust_factor").get<double>();
  simulation.vary = value.at("vary").get<double>();
  simulation.camera_rate_hz = value.at("camera_rate_hz").get<double>();
  simulation.noise.sigma_px = value.at("sigma_px").get<double>();
  simulation.noise.lost_markers = value.at("lost_markers").get<double>();
  simulation.noise.outliers = value.at("outliers").get<double>();
  simulation.marker_error_m = value.value("marker_error_m", 0.0);
  simulation.focal_error = value.value("focal_error", 0.0);
  simulation.occlusions.clear();
  for (const auto& occlusion : value.at("occlusions"))
    simulation.occlusions.push_back({cameraOf(occlusion.at("camera"), rig),
                                     occlusion.at("from_s").get<double>(),
                                     occlusion.at("to_s").get<double>()});
  simulation.bumps.clear();
  for (const auto& bump : value.at("bumps"))
    simulation.bumps.push_back({cameraOf(bump.at("camera"), rig), bump.at("at_s").get<double>(),
                                bump.at("angle_rad").get<double>(), bump.at("distance_m").get<double>(),
                                bump.value("across", false)});
}

void applySettings(const json& value, SessionSettings& settings) {
  RigConfig& rig = settings.rig;
  if (value.at("format").get<int>() != kFormat) throw std::domain_error("another format");
  settings.realtime = value.at("realtime").get<bool>();
  settings.plan.land_at_s = value.at("land_at_s").get<double>();
  rig.tracker = value.at("tracker").get<std::string>();
  rig.calibrator = value.at("calibrator").get<std::string>();
  rig.learn_from_own_pose = value.at("learn_from_own_pose").get<bool>();
  applySimulation(value.at("simulation"), rig);
  applySelfCalibration(value, rig);
  const json& cameras = value.at("cameras");
  rig.simulation.true_camera_from_world.resize(rig.cameras.size());
  for (std::size_t i = 0; i < rig.cameras.size(); ++i) {
    const json& camera = cameras.at(i);
    rig.cameras[i].camera_from_world = poseOf(camera.at("camera_from_world"));
    rig.cameras[i].pose_is_guess = camera.at("initial").get<bool>();
    rig.cameras[i].pose_covariance = covarianceOf(camera);
    rig.replaceFocalLengths(i, camera.value("focal_scale", 1.0));
    rig.simulation.true_camera_from_world[i] = poseOf(camera.at("true_camera_from_world"));
  }
}

const std::string& contentOf(const std::vector<McapAttachment>& attachments, const std::string& name,
                             const std::string& session) {
  const auto found = std::find_if(attachments.begin(), attachments.end(),
                                  [&](const McapAttachment& attachment) { return attachment.name == name; });
  if (found == attachments.end())
    throw Error(ErrorKind::kInput, "the session lacks its " + name, session,
                "give a session that `helical fly --session` wrote");
  return found->content;
}

}  // namespace

std::vector<McapAttachment> toAttachments(const SessionSettings& settings) {
  const RigConfig& rig = settings.rig;
  const json value{{"format", kFormat},
                   {"realtime", settings.realtime},
                   {"land_at_s", settings.plan.land_at_s},
                   {"tracker", rig.tracker},
                   {"calibrator", rig.calibrator},
                   {"learn_from_own_pose", rig.learn_from_own_pose},
                   {"marker_sigma_m", rig.self_calibration.marker_sigma_m},
                   {"focal_sigma", rig.self_calibration.focal_sigma},
                   {"markers_m", markersJson(rig)},
                   {"simulation", simulationJson(rig.simulation)},
                   {"cameras", camerasJson(rig)}};
  return {{kRigName, "application/toml", settings.rig_text},
          {kPlanName, "application/toml", settings.plan_text},
          {kSettingsName, "application/json", value.dump(2)}};
}

SessionSettings fromAttachments(const std::vector<McapAttachment>& attachments, const std::string& session) {
  SessionSettings settings;
  settings.rig_text = contentOf(attachments, kRigName, session);
  settings.plan_text = contentOf(attachments, kPlanName, session);
  settings.rig = parseRig(settings.rig_text, session + ":" + kRigName);
  settings.plan = parsePlan(settings.plan_text, session + ":" + kPlanName);
  try {
    applySettings(json::parse(contentOf(attachments, kSettingsName, session)), settings);
  } catch (const std::exception& failure) {
    throw Error(ErrorKind::kInput, std::string("the session's settings do not make sense: ") + failure.what(),
                session, "give a session that this version of `helical fly --session` wrote");
  }
  return settings;
}

}  // namespace helical
