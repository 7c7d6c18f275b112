// What cameras and tracker together say of a frame, for those who look at several cameras at once: the joint
// refinement, and the search for small knocks.

#include <algorithm>
#include <cmath>

#include "engine/calibration/admission.h"
#include "engine/pipeline/control_set.h"

namespace helical {
namespace {

constexpr int kWitnessesOfStep = 2;  // at least: the detector needs three cameras
// Nearer to the pad's surface it may be jolted by the pad: contact is not smooth.
constexpr double kContactHeightM = 0.2;
// A refinement was asked for: it stands unless it clearly knows less than the camera by itself.
constexpr double kWorseThanAlone = 1.25;

RefinementOutcome outcomeOf(RigRefinement::Correction correction) {
  switch (correction) {
    case RigRefinement::Correction::kNotSought:
      return RefinementOutcome::kCameras;
    case RigRefinement::Correction::kFound:
      return RefinementOutcome::kCorrected;
    case RigRefinement::Correction::kNotNeeded:
      return RefinementOutcome::kKept;
    case RigRefinement::Correction::kUnsound:
      return RefinementOutcome::kUnsound;
    case RigRefinement::Correction::kTooFar:
      return RefinementOutcome::kTooFar;
    case RigRefinement::Correction::kCamerasTooFar:
      return RefinementOutcome::kCamerasTooFar;
    case RigRefinement::Correction::kNoAnswer:
      break;
  }
  return RefinementOutcome::kNoAnswer;
}

}  // namespace

NamedBalls ControlSet::namedBalls(const Observation& observation, const Tracker& tracker, bool outside_gate) const {
  const std::size_t index = indexOf(observation.camera);
  NamedBalls balls;
  balls.exposure = observation.exposure;
  const auto add = [&](int marker, const Eigen::Vector2d& pixel) {
    balls.seen.set(static_cast<std::size_t>(marker));
    balls.pixels[static_cast<std::size_t>(marker)] = pixel.cast<float>();
  };
  if (usable_[index]) {
    const CameraTrack& track = tracker.track(observation.camera);
    if (track.exposure != observation.exposure) return balls;
    for (int m = 0; m < markers_.count(); ++m)
      if (const MarkerTrack& marker = track.markers[static_cast<std::size_t>(m)];
          marker.agrees || (outside_gate && marker.observed))
        add(m, marker.pixel);
  } else if (learning_[index] && calibrations_[index]->calibrator().knowsItsPlace()) {
    for (const LabelledPixel& named : calibrations_[index]->calibrator().named())
      add(named.marker.index(), named.pixel);
  }
  if (observation.count > 0)
    balls.variance = static_cast<float>(0.5 * observation.centroids[0].covariance.trace());
  return balls;
}

void ControlSet::watchSteps(const Observation& observation, const Tracker& tracker, const RigidTransform& flown) {
  const std::size_t index = indexOf(observation.camera);
  const CameraTrack& track = tracker.track(observation.camera);
  if (track.exposure != observation.exposure) return;
  const RigidTransform& camera_from_world = estimates_[index].camera_from_world;
  const Eigen::Vector3d& place = flown.translation;
  if (place.z() < kContactHeightM) return;
  Eigen::Matrix<double, 2, 3> d_point;
  if (!models_[index].project(camera_from_world * place, &d_point)) return;
  // What lies outside the gate, too: a knock throws it there.
  const NamedBalls balls = namedBalls(observation, tracker, true);
  const int moved = steps_.add(observation.camera, balls, d_point * camera_from_world.rotation.toRotationMatrix());
  if (moved >= 0 && usable_[static_cast<std::size_t>(moved)])
    takeOut(static_cast<std::size_t>(moved), kWitnessesOfStep, tracker);
}

void ControlSet::showToRefinement(const Observation& observation, const Tracker& tracker,
                                  const RigidTransform& flown) {
  const NamedBalls balls = namedBalls(observation, tracker, false);
  if (balls.seen.any()) refinement_->see(observation.camera, balls, flown);
}

const char* ControlSet::startRefinement() {
  std::array<RigRefinement::Part, kMaxCameras> parts;
  for (std::size_t i = 0; i < cameras_; ++i) {
    RigRefinement::Part& part = parts[i];
    part.estimate = estimates_[i];
    part.frozen = frozen_[i];
    part.hidden = hidden_[i];
    part.holds = estimates_[i].status == CameraStatus::kCalibrated && !learning_[i];
    // One that learns and is frozen could not follow what is found.
    part.used = part.holds || (learning_[i] && !frozen_[i] && calibrations_[i]->calibrator().namesCentroids() &&
                               calibrations_[i]->calibrator().knowsItsPlace());
  }
  const char* refusal = refinement_->start({parts.data(), cameras_});
  if (refusal != nullptr) return refusal;
  for (std::size_t i = 0; i < cameras_; ++i) refining_[i] = parts[i].used && !frozen_[i];
  return nullptr;
}

void ControlSet::leaveRefinement(std::size_t camera) {
  // What was solved for with another pose of this camera would not be true with this one, though it only held the
  // world for the others.
  if (refinement_->uses(cameraId(static_cast<int>(camera)))) {
    refinement_->stop();
    endRefinement(RefinementOutcome::kOvertaken);
  }
  refining_[camera] = refined_[camera] = false;
}

void ControlSet::forgetViews(std::size_t camera) {
  if (refinement_->running()) endRefinement(RefinementOutcome::kOvertaken);
  refinement_->forget(cameraId(static_cast<int>(camera)));
}

void ControlSet::endRefinement(RefinementOutcome outcome) {
  ++report_.ended;
  report_.outcome = outcome;
  report_.balls_off_m = report_.focal_off = 0.0;
  report_.balls_hardly_seen = refinement_->ballsHardlySeen();
  for (int m = 0; m < markers_.count(); ++m)
    report_.balls_off_m = std::max(report_.balls_off_m,
                                   (markers_.inBody(markerId(m)) - rig_markers_.inBody(markerId(m))).norm());
  for (std::size_t i = 0; i < cameras_; ++i)
    report_.focal_off = std::max(report_.focal_off, std::abs(focalScale(cameraId(static_cast<int>(i))) - 1.0));
}

bool ControlSet::takeCorrection() {
  const bool fresh = fresh_correction_;
  fresh_correction_ = false;
  return fresh;
}

void ControlSet::setFocalScale(std::size_t camera, double scale) {
  const CameraId id = cameraId(static_cast<int>(camera));
  if (scale == focalScale(id)) return;
  refinement_->setFocalScale(id, scale);
  correctFromRefinement();
}

/// All who look by balls and lenses, at once; the tracker when the loop asks. What speaks for a knock stays: images
/// are where they were.
void ControlSet::correctFromRefinement() {
  markers_ = refinement_->markers();
  for (std::size_t i = 0; i < cameras_; ++i) {
    const CameraId id = cameraId(static_cast<int>(i));
    models_[i] = rig_models_[i].withFocalScale(focalScale(id));
    calibrations_[i]->correct(models_[i], markers_);
  }
  for (const auto& teacher : teachers_) teacher->correct(markers_, models_);
  fresh_correction_ = true;
}

/// What it has learnt so far it learnt from other balls. A frozen one stays where it is until it is resumed.
void ControlSet::learnAnew(std::size_t camera) {
  calibrations_[camera]->restart(estimates_[camera].camera_from_world, CameraStatus::kCalibrating);
  bounds_[camera].restart();
  if (frozen_[camera]) return;
  estimates_[camera] = calibrations_[camera]->estimate();
  refined_[camera] = false;
}

/// Cameras that are known as well by it as they were, or better. One that learns goes on from there. Where balls or
/// focal lengths were wrong, what a camera knew by itself rests on the wrong ones and is no measure: all follow.
void ControlSet::takeRefinement(const Eigen::Vector3d& helicopter_in_world) {
  const double reach_m = AdmissionOptions().reach_m;
  const RigRefinement::Correction correction = refinement_->correction();
  const bool corrects = correction == RigRefinement::Correction::kFound;
  bool placed = corrects;
  if (corrects) {
    correctFromRefinement();
    corrected_ = true;
  }
  for (std::size_t i = 0; i < cameras_; ++i) {
    CameraEstimate found;
    if (refining_[i]) found = refinement_->answer(cameraId(static_cast<int>(i)));
    refining_[i] = false;
    if (found.status != CameraStatus::kCalibrated) {
      if (corrects && learning_[i]) learnAnew(i);
      continue;
    }
    const double doubt = uncertaintyAround(models_[i], found, helicopter_in_world, reach_m);
    const bool admissible = usable_[i] || doubt < AdmissionOptions().admit_uncertainty_m;
    const double alone = uncertaintyAround(models_[i], estimates_[i], helicopter_in_world, reach_m);
    if (!corrects && (!admissible || doubt > kWorseThanAlone * alone)) continue;
    if (!admissible && learning_[i]) {
      calibrations_[i]->restart(found.camera_from_world, estimates_[i].status);
      estimates_[i] = calibrations_[i]->estimate();
      continue;
    }
    found_by_cold_start_[i] = false;
    if (learning_[i] && calibrations_[i]->goOnFrom(found)) {
      estimates_[i] = calibrations_[i]->estimate();
    } else {
      placed = true;
      place(i, found);
    }
    refined_[i] = true;
  }
  if (placed) refinement_->startAfresh();
  endRefinement(outcomeOf(correction));
}

}  // namespace helical
