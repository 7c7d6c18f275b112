#include "engine/pipeline/control_set.h"

#include <algorithm>
#include <cmath>

namespace helical {
namespace {

constexpr TimeNs kTeaching = 50 * kNanosecondsPerMillisecond;  // a view is of now for so long
constexpr int kTeachers = 2;
constexpr int kFewestBallsToStart = 4;
constexpr int kSureBalls = 3;  // that another camera sees where the pose says: then it is not the pose

}  // namespace

ControlSet::ControlSet(const RigConfig& rig)
    : cameras_(rig.cameras.size()),
      markers_(rig.markers_in_body),
      rig_markers_(rig.markers_in_body),
      learn_from_own_pose_(rig.learn_from_own_pose) {
  for (const CameraConfig& camera : rig.cameras) models_.push_back(camera.model);
  rig_models_ = models_;
  for (std::size_t i = 0; i < cameras_; ++i) {
    const CameraConfig& camera = rig.cameras[i];
    if (camera.camera_from_world) {
      estimates_[i].camera_from_world = *camera.camera_from_world;
      if (camera.pose_covariance) estimates_[i].covariance = *camera.pose_covariance;
      // A pose that the rig file vouches for flies; a first guess waits for its calibration.
      estimates_[i].status = camera.pose_is_guess ? CameraStatus::kCalibrating : CameraStatus::kCalibrated;
      if (!camera.pose_is_guess) given_[i] = estimates_[i];
    }
    learning_[i] = camera.learns();
    rank_[i] = camera.learns() ? 1 : 0;
    calibrations_[i] =
        newCalibration(rig, cameraId(static_cast<int>(i)), rig.calibrator, rig.simulation.seed + i);
  }
  const auto known = std::count_if(rig.cameras.begin(), rig.cameras.end(),
                                   [](const CameraConfig& camera) { return !camera.learns(); });
  if (known < kTeachers && known < static_cast<long>(cameras_) && !learn_from_own_pose_ &&
      markers_.count() >= kFewestBallsToStart) {
    cold_start_ = std::make_unique<ColdStart>(models_, markers_, rig.helicopter.standing_height, estimates());
    for (std::size_t i = 0; i < cameras_; ++i) found_by_cold_start_[i] = learning_[i];
  }
  RigRefinementOptions refinement;
  refinement.self = rig.self_calibration;
  refinement_ = std::make_unique<RigRefinement>(models_, markers_, refinement);
  // A rank for each camera that may be knocked, one after the other.
  for (std::size_t r = 0; r <= cameras_ + 1; ++r)
    teachers_.push_back(
        makeTracker(rig.tracker, rig.tracking, markers_, models_, rig.helicopter.standing_height));
  refreshUsable();
}

void ControlSet::hide(CameraId camera, bool hidden) {
  hidden_[indexOf(camera)] = hidden;
  refreshUsable();
}

void ControlSet::refreshUsable() {
  for (std::size_t i = 0; i < cameras_; ++i)
    usable_[i] = estimates_[i].status == CameraStatus::kCalibrated && !hidden_[i];
  for (std::size_t i = 0; i < cameras_; ++i)
    if (estimates_[i].status == CameraStatus::kCalibrated) set_aside_[i].reset();
}

bool ControlSet::camerasDisagree() const {
  for (std::size_t i = 0; i < cameras_; ++i)
    if (set_aside_[i] && !hidden_[i]) return true;
  return false;
}

std::array<const CameraEstimate*, kMaxCameras> ControlSet::places() const {
  std::array<const CameraEstimate*, kMaxCameras> places{};
  for (std::size_t i = 0; i < cameras_; ++i) {
    if (usable_[i]) places[i] = &estimates_[i];
    if (set_aside_[i] && !hidden_[i]) places[i] = &*set_aside_[i];
  }
  return places;
}

void ControlSet::standsAsBefore(CameraId camera) {
  const std::size_t index = indexOf(camera);
  steps_.forget(camera);
  detectors_[index] = KnockDetector();
  if (!set_aside_[index]) return;
  // `place` forgets the place that it is given.
  const CameraEstimate before = *set_aside_[index];
  place(index, before);
}

void ControlSet::swapCalibration(CameraId camera, std::unique_ptr<CameraCalibration>& calibration) {
  const std::size_t index = indexOf(camera);
  if (!calibration) return;
  calibrations_[index].swap(calibration);
  calibrations_[index]->correct(models_[index], markers_);
  if (!learning_[index]) return;
  set_aside_[index].reset();  // where it stood is to be forgotten
  leaveRefinement(index);
  estimates_[index] = calibrations_[index]->estimate();
  bounds_[index].restart();
  refreshUsable();
}

const char* ControlSet::obey(const CalibrationOrder& order) {
  const std::size_t index = indexOf(order.camera);
  switch (order.kind) {
    case CalibrationOrderKind::kFreeze:
      frozen_[index] = true;
      // It stays where it is, whatever a refinement that goes on will find.
      if (refining_[index]) leaveRefinement(index);
      return nullptr;
    case CalibrationOrderKind::kResume:
      frozen_[index] = false;
      return nullptr;
    case CalibrationOrderKind::kAccept:
      if (!learning_[index]) return "it does not learn";
      if (!calibrations_[index]->accept()) return "it does not know its place, or disagrees";
      estimates_[index] = calibrations_[index]->estimate();
      refreshUsable();
      return nullptr;
    case CalibrationOrderKind::kTrustRig:
      if (!given_[index]) return "the rig file does not say where it stands";
      found_by_cold_start_[index] = false;
      place(index, *given_[index]);
      setFocalScale(index, 1.0);
      return nullptr;
    case CalibrationOrderKind::kAdopt:
      found_by_cold_start_[index] = false;
      place(index, {order.camera_from_world, order.covariance, CameraStatus::kCalibrated});
      setFocalScale(index, order.focal_scale);
      return nullptr;
    case CalibrationOrderKind::kRefine:
      return startRefinement();
  }
  return nullptr;
}

void ControlSet::place(std::size_t camera, const CameraEstimate& estimate) {
  estimates_[camera] = estimate;
  leaveRefinement(camera);
  learning_[camera] = false;
  rank_[camera] = 0;
  detectors_[camera] = KnockDetector();
  bounds_[camera].restart();
  closeRanks();
  refreshUsable();
}

const CameraCalibration* ControlSet::calibration(CameraId camera) const {
  return learning_[indexOf(camera)] ? calibrations_[indexOf(camera)].get() : nullptr;
}

const char* ControlSet::method(CameraId camera) const {
  const std::size_t index = indexOf(camera);
  if (refined_[index]) return "refined";
  if (learning_[index]) return calibrations_[index]->calibrator().name();
  return found_by_cold_start_[index] ? "cold-start" : nullptr;
}

const char* ControlSet::instruction() const {
  return cold_start_ && !corrected_ ? cold_start_->instruction() : nullptr;
}

void ControlSet::startCold(const Observation& observation, bool airborne) {
  // It knows the balls as the rig has them; cameras that still have no place learn from the others.
  if (corrected_) return;
  // In flight it goes on only for cameras that still have no place.
  bool wanted = !airborne;
  for (std::size_t i = 0; i < cameras_; ++i) wanted = wanted || (found_by_cold_start_[i] && learning_[i]);
  if (!wanted || hidden_[indexOf(observation.camera)]) return;
  cold_start_->step(observation);
  if (!cold_start_->takeAnswer()) return;
  for (std::size_t i = 0; i < cameras_; ++i) {
    if (!found_by_cold_start_[i] || frozen_[i] || (airborne && !learning_[i])) continue;
    const CameraEstimate& answer = cold_start_->answer()[i];
    if (answer.status == CameraStatus::kCalibrated) {
      place(i, answer);
    } else if (!usable_[i] || answer.status == CameraStatus::kUncalibrated) {
      estimates_[i] = answer;
      learning_[i] = true;
      rank_[i] = std::max(rank_[i], 1);
    }
  }
  refreshUsable();
}

void ControlSet::learn(const Observation& observation, const Tracker& tracker, bool airborne) {
  const std::size_t index = indexOf(observation.camera);
  if (cold_start_) startCold(observation, airborne);
  // What somebody carries about the tracker does not follow, and every camera seems to disagree.
  const bool judges = airborne || !cold_start_;
  if (const int witnesses = judges && usable_[index] ? witnessesOfKnock(observation, tracker) : 0; witnesses > 0)
    takeOut(index, witnesses, tracker);
  std::optional<RigidTransform> flown;
  if (tracker.acquired()) flown = tracker.predict(observation.exposure, true).state.world_from_body;
  if (flown && judges && usable_[index]) watchSteps(observation, tracker, *flown);
  teachOthers(observation, airborne);
  if (learning_[index] && !hidden_[index] && !frozen_[index]) teach(observation, tracker, airborne);
  if (flown && !hidden_[index]) showToRefinement(observation, tracker, *flown);
  if (refinement_->work())
    takeRefinement(tracker.predict(observation.exposure, airborne).state.world_from_body.translation);
  refreshUsable();
}

int ControlSet::witnessesOfKnock(const Observation& observation, const Tracker& tracker) {
  const std::size_t index = indexOf(observation.camera);
  const CameraTrack& track = tracker.track(observation.camera);
  KnockEvidence evidence;
  evidence.exposure = observation.exposure;
  evidence.in_view = std::min(observation.count, track.predicted_count);
  evidence.agreeing = track.agreeing_count;
  for (std::size_t i = 0; i < cameras_; ++i) {
    const CameraTrack& other = tracker.track(cameraId(static_cast<int>(i)));
    evidence.witnesses += i != index && usable_[i] && other.agreeing_count >= kSureBalls &&
                          observation.exposure - other.exposure < kTeaching;
  }
  return detectors_[index].add(evidence) ? evidence.witnesses : 0;
}

void ControlSet::takeOut(std::size_t camera, int witnesses, const Tracker& tracker) {
  const bool named = witnesses > 1;
  if (named)
    ++knocks_found_[camera];
  else
    set_aside_[camera] = estimates_[camera];
  found_by_cold_start_[camera] = refined_[camera] = refining_[camera] = false;
  forgetViews(camera);
  steps_.forget(cameraId(static_cast<int>(camera)));
  int highest = 0;
  for (std::size_t i = 0; i < cameras_; ++i)
    if (i != camera) highest = std::max(highest, rank_[i]);
  const bool taught = somebodyLearnsAt(highest + 1);
  rank_[camera] = highest + 1;
  learning_[camera] = true;
  // Who teaches it starts from what all of them knew up to now.
  if (!taught) teachers_[static_cast<std::size_t>(highest + 1)]->adopt(tracker);
  closeRanks();
  calibrations_[camera]->restart(estimates_[camera].camera_from_world,
                                 named ? CameraStatus::kRejected : CameraStatus::kCalibrating);
  estimates_[camera] = calibrations_[camera]->estimate();
  bounds_[camera].restart();
  refreshUsable();
}

void ControlSet::closeRanks() {
  std::array<bool, kMaxCameras + 2> taken{};
  for (std::size_t i = 0; i < cameras_; ++i) taken[static_cast<std::size_t>(rank_[i])] = true;
  taken[0] = true;  // who has rank 0 was never taught: nobody moves there
  int next = 1;
  for (int r = 1; r < static_cast<int>(teachers_.size()); ++r) {
    if (!taken[static_cast<std::size_t>(r)]) continue;
    std::swap(teachers_[static_cast<std::size_t>(next)], teachers_[static_cast<std::size_t>(r)]);
    for (std::size_t i = 0; i < cameras_; ++i)
      if (rank_[i] == r) rank_[i] = next;
    ++next;
  }
}

bool ControlSet::somebodyLearnsAt(int rank) const {
  for (std::size_t i = 0; i < cameras_; ++i)
    if (learning_[i] && rank_[i] == rank) return true;
  return false;
}

void ControlSet::teachOthers(const Observation& observation, bool airborne) {
  if (learn_from_own_pose_) return;
  const int rank = rank_[indexOf(observation.camera)];
  for (int r = rank + 1; r < static_cast<int>(teachers_.size()); ++r)
    if (somebodyLearnsAt(r))
      teachers_[static_cast<std::size_t>(r)]->update(observation, estimates(), usable(), airborne);
}

void ControlSet::teach(const Observation& observation, const Tracker& tracker, bool airborne) {
  const std::size_t index = indexOf(observation.camera);
  const Tracker& teacher =
      learn_from_own_pose_ ? tracker : *teachers_[static_cast<std::size_t>(rank_[index])];
  if (!teacher.acquired() || observation.exposure - teacher.lastUpdate() > kTeaching) return;
  int views = 0;
  for (std::size_t i = 0; i < cameras_; ++i) {
    const CameraTrack& track = teacher.track(cameraId(static_cast<int>(i)));
    views += usable_[i] && rank_[i] < rank_[index] && track.selected_count >= 2 &&
             observation.exposure - track.exposure < kTeaching;
  }
  if (views < kTeachers && !learn_from_own_pose_) return;
  const TrackedState helicopter = teacher.predict(observation.exposure, airborne);
  calibrations_[index]->step(observation, helicopter);
  const bool was_in = estimates_[index].status == CameraStatus::kCalibrated;
  estimates_[index] = calibrations_[index]->estimate();
  // What it took for the balls so far may have been others.
  if (was_in && estimates_[index].status != CameraStatus::kCalibrated) forgetViews(index);
  addToBound(observation, tracker, helicopter.state.world_from_body);
}

void ControlSet::addToBound(const Observation& observation, const Tracker& tracker,
                            const RigidTransform& world_from_body) {
  if (observation.count == 0) return;
  const std::size_t index = indexOf(observation.camera);
  BoundFrame frame;
  frame.world_from_body = world_from_body;
  frame.sigma_px = std::sqrt(0.5 * observation.centroids[0].covariance.trace());
  // Before the camera knows the names only the number of its balls is known.
  frame.balls = std::min(observation.count, markers_.count());
  for (std::size_t i = 0; i < cameras_; ++i) {
    const CameraTrack& track = tracker.track(cameraId(static_cast<int>(i)));
    const bool teaches = i != index && usable_[i] && (learn_from_own_pose_ || rank_[i] < rank_[index]);
    if (!teaches || observation.exposure - track.exposure >= kTeaching) continue;
    std::array<MarkerId, kMaxMarkers> seen;
    std::size_t count = 0;
    for (int m = 0; m < markers_.count(); ++m)
      if (track.markers[static_cast<std::size_t>(m)].selected) seen[count++] = markerId(m);
    frame.pose_information += poseInformation(models_[i], estimates_[i].camera_from_world, markers_,
                                              {seen.data(), count}, world_from_body, frame.sigma_px);
  }
  bounds_[index].add(models_[index], markers_, calibrations_[index]->calibrator().estimate(), frame);
}

}  // namespace helical
