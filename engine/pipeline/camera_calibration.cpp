#include "engine/pipeline/camera_calibration.h"

namespace helical {
namespace {

// What most methods do not account for, per axis: centroids and helicopter pose have offsets that stay for
// many frames, so that a camera's true error is some millimetres however many frames it has seen. Believed to
// fractions of one, it would pull at the pose against the other cameras.
constexpr double kLastingOrientation = 7e-4;  // rad
constexpr double kLastingPosition = 2e-3;     // m
constexpr double kDoubtLasts =
    1.0;  // s of residuals over the limit, after which the labelling itself was wrong

// Labellings that are tried with one image have so many balls together, that the image does not come late. A
// count, not a time, so that a flight repeats.
constexpr int kBallsPerStep = 16;

// A frame that no labelling explains better has a false centroid in it, and of a nearly square layout any
// rotation may fit that best.
constexpr double kPlausibleRmsPx = 4.0;

constexpr std::string_view kMethodWithoutGuess = "joint";

}  // namespace

CameraCalibration::CameraCalibration(std::string_view method, const CameraModel& camera,
                                     const MarkerLayout& markers, const std::optional<RigidTransform>& guess,
                                     std::uint64_t seed, const CalibratorOptions& options)
    : camera_(camera),
      markers_(markers),
      has_guess_(guess.has_value()),
      guess_(guess.value_or(RigidTransform{})),
      calibrator_(makeCalibrator(method, options, camera, markers, seed)),
      tracks_({}, markers.count()),
      search_(camera, markers) {
  if (!has_guess_ && !calibrator_->namesCentroids())
    calibrator_ = makeCalibrator(kMethodWithoutGuess, options, camera, markers, seed);
  calibrator_->restart(guess_);
}

void CameraCalibration::restart(const RigidTransform& guess, CameraStatus status) {
  guess_ = guess;
  has_guess_ = true;
  calibrator_->restart(guess_);
  tracks_.forget();
  search_.stop();
  named_ = false;
  labellings_ = {};
  expelAs(status);
}

void CameraCalibration::startSeeking(const Observation& observation, const TrackedState& helicopter) {
  named_ = false;
  search_.stop();
  if (observation.count != markers_.count()) return;
  LabellingFrame frame;
  frame.world_from_body = helicopter.state.world_from_body;
  Names as_they_stand;
  as_they_stand.fill(-1);
  for (int c = 0; c < observation.count; ++c) {
    const auto i = static_cast<std::size_t>(c);
    frame.pixels[i] = observation.centroids[i].pixel;
    as_they_stand[i] = c;
  }
  tracks_.restart(observation, as_they_stand);
  // A camera that was only covered is where it was: its own estimate judges better than the first guess.
  search_.start(frame, isAdmitted() ? calibrator_->estimate().camera_from_world : guess_);
}

void CameraCalibration::seekLabels() {
  search_.advance(std::max(1, kBallsPerStep / markers_.count()));
  if (search_.running()) return;
  labellings_ = search_.nearest(LabellingCriterion::kNearestPlausible);
  const ScoredLabelling* best = search_.found().best(LabellingCriterion::kNearestPlausible);
  if (best == nullptr || best->resection.rms_px > kPlausibleRmsPx) return tracks_.forget();
  for (int c = 0; c < best->labelling.count; ++c)
    track_of_marker_[best->labelling.marker[static_cast<std::size_t>(c)]] = c;
  named_ = true;
  if (isAdmitted()) return;
  calibrator_->restart(guess_);
  expelAs(CameraStatus::kCalibrating);
}

void CameraCalibration::expelAs(CameraStatus status) {
  admission_ = {};
  admission_.status = status;
  accepted_ = false;
  doubtful_since_ = -1;
}

std::span<const LabelledPixel> CameraCalibration::keepLabels(const Observation& observation,
                                                             const TrackedState& helicopter) {
  if (tracks_.lost()) startSeeking(observation, helicopter);
  const Names centroid_of_track = tracks_.follow(observation);
  if (search_.running()) seekLabels();
  if (!named_) return {};
  std::size_t count = 0;
  for (int m = 0; m < markers_.count(); ++m) {
    const int track = track_of_marker_[static_cast<std::size_t>(m)];
    const int name = centroid_of_track[static_cast<std::size_t>(track)];
    if (name < 0) continue;
    const Centroid& centroid = observation.centroids[static_cast<std::size_t>(name)];
    pixels_[count++] = {markerId(m), centroid.pixel, centroid.covariance};
  }
  return {pixels_.data(), count};
}

bool CameraCalibration::accept() {
  const bool knows = calibrator_->namesCentroids() ? calibrator_->knowsItsPlace() : named_;
  const bool agrees =
      admission_.observed_s > 0.0 && admission_.residual < admission_options_.drop_residual;
  if (!knows || !agrees) return false;
  admission_.status = CameraStatus::kCalibrated;
  accepted_ = true;
  return true;
}

void CameraCalibration::correct(const CameraModel& camera, const MarkerLayout& markers) {
  camera_ = camera;
  markers_ = markers;
  if (search_.running()) tracks_.forget();
  search_.correct(camera, markers);
  calibrator_->correct(camera, markers);
}

bool CameraCalibration::goOnFrom(const CameraEstimate& estimate) {
  if (!calibrator_->goOnFrom(estimate)) return false;
  admission_.status = CameraStatus::kCalibrated;
  doubtful_since_ = -1;
  return true;
}

void CameraCalibration::step(const Observation& observation, const TrackedState& helicopter) {
  CalibrationFrame frame{
      observation.exposure, helicopter.state.world_from_body, helicopter.pose_covariance, {}, &observation};
  if (!calibrator_->namesCentroids()) frame.pixels = keepLabels(observation, helicopter);
  calibrator_->step(frame);
  if (calibrator_->namesCentroids()) frame.pixels = calibrator_->named();
  if (isAdmitted() && !calibrator_->knowsItsPlace()) expelAs(CameraStatus::kRejected);
  judge(frame, helicopter.state.world_from_body.translation);
}

void CameraCalibration::judge(const CalibrationFrame& frame, const Eigen::Vector3d& helicopter_in_world) {
  const CameraEstimate now = calibrator_->estimate();
  const AdmissionEvidence evidence{
      frame.exposure,
      accepted_ ? 0.0 : uncertaintyAround(camera_, now, helicopter_in_world, admission_options_.reach_m),
      normalisedResidual(camera_, markers_, now, frame)};
  admission_ = admit(admission_options_, admission_, evidence);
  if (admission_.residual < admission_options_.drop_residual) {
    doubtful_since_ = -1;
  } else if (doubtful_since_ < 0) {
    doubtful_since_ = frame.exposure;
  } else if (toSeconds(frame.exposure - doubtful_since_) > kDoubtLasts) {
    // The next frame seeks anew; the residual that it was given up for says nothing about what it finds.
    if (calibrator_->namesCentroids())
      calibrator_->restart(guess_);
    else
      tracks_.forget();
    expelAs(isAdmitted() ? CameraStatus::kRejected : admission_.status);
  }
}

CameraEstimate CameraCalibration::estimate() const {
  CameraEstimate result = calibrator_->estimate();
  result.status = admission_.status;
  if (!has_guess_ && !calibrator_->knowsItsPlace()) result.status = CameraStatus::kUncalibrated;
  if (calibrator_->coversLastingOffsets()) return result;
  result.covariance.diagonal().head<3>().array() += kLastingOrientation * kLastingOrientation;
  result.covariance.diagonal().tail<3>().array() += kLastingPosition * kLastingPosition;
  return result;
}

std::unique_ptr<CameraCalibration> newCalibration(const RigConfig& rig, CameraId id, std::string_view method,
                                                  std::uint64_t seed) {
  const CameraConfig& camera = rig.cameras[static_cast<std::size_t>(id.index())];
  return std::make_unique<CameraCalibration>(method, camera.model, rig.markers_in_body, camera.camera_from_world, seed,
                                             rig.calibration);
}

}  // namespace helical
