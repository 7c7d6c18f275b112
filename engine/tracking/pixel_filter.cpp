#include "engine/tracking/pixel_filter.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "engine/base/check.h"
#include "engine/geometry/rotation.h"

namespace helical {
namespace {

/// 99.9 % points of chi-square for 2, 4, 6, 8 ... degrees of freedom: the joint test of a camera's features.
constexpr std::array<double, 16> kJointLimit{13.8, 18.5, 22.5, 26.1, 29.6, 32.9, 36.1, 39.3,
                                             42.3, 45.3, 48.3, 51.2, 54.1, 56.9, 59.7, 62.5};
constexpr int kProbation = 2;  // frames that a rejected feature has to agree before it counts again
constexpr double kDoubtfulAgreement = 0.6;  // of the centroids in view: below, the pose itself is in doubt
constexpr double kAgreementGain = 0.05;     // an average over some 20 observations
constexpr double kForeseen = 0.3;           // s, over which the motion model is better than standing still
// A partly hidden ball's centre of gravity is off by this many radii (standard deviation) per share of area
// missing: measured on rendered images.
constexpr double kHiddenShift = 0.48;
constexpr double kPlainSigma = 0.10;        // px per axis, of a whole ball's centre of gravity
constexpr double kLongestPrediction = 1.0;  // s
constexpr TimeNs kLongestBack = 30 * kNanosecondsPerMillisecond;  // cameras may be this far out of order
constexpr TimeNs kRecentView = 100 * kNanosecondsPerMillisecond;
constexpr double kGapSpeedLimit = 1.5;  // m/s, of the velocity guessed across a gap
// What nobody saw nobody steered: in a gap its velocity [m/s] and its turning [rad/s] become anything up to this.
constexpr double kGapSpeedSigma = 0.3, kGapSpeedSigmaPerS = 0.7, kLargestGapSpeedSigma = 1.5;
constexpr double kGapSpinSigma = 1.0, kGapSpinSigmaPerS = 3.0, kLargestGapSpinSigma = 6.0;
constexpr double kGapWithoutATurn = 0.2;  // s, over which two headings tell how it turns

// How far the pose may be off once balls and focal lengths are corrected, per axis.
constexpr double kCorrectedPosition = 0.02;  // m
constexpr double kCorrectedRotation = 0.01;  // rad

using MeasurementMatrix =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 2 * kMaxMarkers, 2 * kMaxMarkers>;
using MeasurementVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 2 * kMaxMarkers, 1>;
using MeasurementJacobian = Eigen::Matrix<double, Eigen::Dynamic, 12, 0, 2 * kMaxMarkers, 12>;
using CameraJacobian = Eigen::Matrix<double, Eigen::Dynamic, 6, 0, 2 * kMaxMarkers, 6>;

/// Variance of a centroid's lasting offset over that of a region's centre of gravity: the offsets of fitted
/// discs are as much smaller as their noise is.
double biasShare(const Eigen::Matrix2d& noise) {
  return std::min(1.0, 0.5 * noise.trace() / (kPlainSigma * kPlainSigma));
}

Matrix6d poseBlock(const Matrix12d& covariance) {
  Matrix6d pose;
  pose << covariance.block<3, 3>(kPositionError, kPositionError),
      covariance.block<3, 3>(kPositionError, kRotationError),
      covariance.block<3, 3>(kRotationError, kPositionError),
      covariance.block<3, 3>(kRotationError, kRotationError);
  return pose;
}

}  // namespace

PixelFilter::PixelFilter(const TrackerOptions& options, const MarkerLayout& markers,
                         std::vector<CameraModel> cameras, double standing_height)
    : options_(options),
      markers_(markers),
      cameras_(std::move(cameras)),
      standing_height_(standing_height),
      model_(options.spin_decay_s),
      noise_({options.acceleration_noise_lateral, options.acceleration_noise_vertical,
              options.spin_noise_tilt, options.spin_noise_yaw}),
      acquisition_(markers, cameras_) {}

void PixelFilter::correct(const MarkerLayout& markers, std::span<const CameraModel> cameras) {
  markers_ = markers;
  std::copy(cameras.begin(), cameras.end(), cameras_.begin());
  acquisition_.correct(markers, cameras);
  // The next frames say where it is by these: not as a velocity, and not outside the gates.
  covariance_.block<3, 3>(kPositionError, kPositionError).diagonal().array() += kCorrectedPosition * kCorrectedPosition;
  covariance_.block<3, 3>(kRotationError, kRotationError).diagonal().array() += kCorrectedRotation * kCorrectedRotation;
}

void PixelFilter::adopt(const Tracker& other) {
  const auto* const same = dynamic_cast<const PixelFilter*>(&other);
  HELICAL_CHECK(same != nullptr && same->cameras_.size() == cameras_.size());
  *this = *same;
}

TrackedState PixelFilter::predict(TimeNs time, bool airborne) const {
  TrackedState result{time, state_, Matrix6d::Identity()};
  if (!acquired_) return result;
  const double ahead = toSeconds(time - time_);
  Matrix12d covariance = covariance_;
  model_.propagate(result.state, covariance, noise_.noise(), std::min(ahead, kLongestPrediction), airborne);
  result.pose_covariance = poseBlock(covariance) + biasCovariance(time);
  if (ahead > kLongestPrediction) {
    // Beyond a second the model knows nothing: it may have gone anywhere and turned any way.
    const double drift = kGapSpeedLimit * (ahead - kLongestPrediction);
    result.pose_covariance.diagonal().head<3>().array() += drift * drift;
    result.pose_covariance.diagonal().tail<3>().array() += kPi * kPi;
  }
  return result;
}

Matrix6d PixelFilter::biasCovariance(TimeNs time) const {
  Matrix6d information = Matrix6d::Identity();
  for (std::size_t c = 0; c < cameras_.size(); ++c)
    if (tracks_[c].selected_count > 0 && time - tracks_[c].exposure < kRecentView)
      information += view_information_[c];
  return options_.centroid_bias_px * options_.centroid_bias_px *
         information.ldlt().solve(Matrix6d::Identity());
}

void PixelFilter::update(const Observation& observation, std::span<const CameraEstimate> cameras,
                         std::span<const bool> usable, bool airborne) {
  const auto index = static_cast<std::size_t>(observation.camera.index());
  CameraTrack& track = tracks_[index];
  track = CameraTrack{};
  track.exposure = observation.exposure;
  if (!usable[index]) return;
  if (acquired_ && time_ - observation.exposure > kLongestBack) return;
  acquisition_.add(observation);
  const bool gap = toSeconds(observation.exposure - last_update_) > options_.reacquire_after_s;
  if (!acquired_ || gap || agreement_ < kDoubtfulAgreement) {
    auto fit =
        acquisition_.attempt(observation.exposure, cameras, usable, priorAt(observation.exposure, airborne));
    if (fit && !isWithinReach(fit->world_from_body.translation, observation.exposure, airborne)) fit.reset();
    if (fit)
      restart(*fit, observation.exposure);
    else if (!acquired_ || gap)
      return;
  }
  model_.propagate(state_, covariance_, noise_.noise(), toSeconds(observation.exposure - time_), airborne);
  time_ = observation.exposure;

  Features features;
  predictFeatures(observation, cameras[index], features);
  nameFeatures(observation, features, track);
  select(observation.camera, cameras[index], features);
  if (correctWithinReach(cameras[index], features, airborne)) {
    last_update_ = std::max(last_update_, observation.exposure);
    last_good_ = state_;
  }
  report(observation, cameras[index], features, track);
  view_information_[index].setZero();
  for (const Feature& feature : features)
    if (feature.selected)
      view_information_[index] += feature.d_pose.transpose() * feature.d_pose / biasShare(feature.noise);
  const int in_view = std::min(observation.count, markers_.count());
  if (in_view >= 2)
    agreement_ += kAgreementGain * (static_cast<double>(track.selected_count) / in_view - agreement_);
}

bool PixelFilter::isWithinReach(const Eigen::Vector3d& place, TimeNs time, bool airborne) {
  if (!acquired_ || !airborne) return true;
  return jumps_.believes(last_good_.world_from_body.translation, place, toSeconds(time - last_update_));
}

PosePrior PixelFilter::priorAt(TimeNs time, bool airborne) const {
  PosePrior prior;
  if (!acquired_) {
    prior.world_from_body.translation.z() = standing_height_;
    return prior;
  }
  const double gap = toSeconds(time - last_update_);
  HelicopterState guess = last_good_;
  model_.propagate(guess, std::min(gap, kForeseen), airborne);
  prior.world_from_body = guess.world_from_body;
  prior.position_radius = 0.3 + 1.5 * gap;
  // A pose that does not explain what is seen may be turned any way.
  const bool doubtful = agreement_ < kDoubtfulAgreement;
  prior.yaw_range = doubtful ? kPi : std::min(kPi, 0.5 + 4.0 * gap);
  prior.yaw_sigma = doubtful ? 2.0 : 0.15 + 1.0 * gap;
  prior.tilt_limit = 0.8;
  return prior;
}

void PixelFilter::restart(const PoseFit& fit, TimeNs time) {
  const double gap = toSeconds(time - last_update_);
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero(), spin = Eigen::Vector3d::Zero();
  double velocity_sigma = 0.02, spin_sigma = 0.1;
  if (acquired_) {
    velocity = (fit.world_from_body.translation - last_good_.world_from_body.translation) / std::max(gap, 0.05);
    velocity *= std::min(1.0, kGapSpeedLimit / std::max(velocity.norm(), 1e-9));
    velocity_sigma = std::min(kLargestGapSpeedSigma, kGapSpeedSigma + kGapSpeedSigmaPerS * std::max(0.0, gap));
    // Between two poses found one soon after the other it turned as they say.
    if (gap > options_.reacquire_after_s && gap < kGapWithoutATurn)
      spin = logSO3(last_good_.world_from_body.rotation.conjugate() * fit.world_from_body.rotation) / gap;
    spin_sigma = std::min(kLargestGapSpinSigma, kGapSpinSigma + kGapSpinSigmaPerS * std::max(0.0, gap));
  }
  state_.world_from_body = fit.world_from_body;
  state_.velocity_in_world = velocity;
  state_.angular_velocity_in_body = spin;
  // The views were up to a frame apart while the helicopter moved: a few pixels that the fit's own residual
  // hides.
  const double pixel_sigma = acquired_ ? 3.0 : 0.5;
  Matrix6d information = fit.information / (pixel_sigma * pixel_sigma);
  information.diagonal().array() += 1.0;
  const Matrix6d pose = information.ldlt().solve(Matrix6d::Identity());
  covariance_.setZero();
  covariance_.block<3, 3>(kPositionError, kPositionError) = pose.topLeftCorner<3, 3>();
  covariance_.block<3, 3>(kPositionError, kRotationError) = pose.topRightCorner<3, 3>();
  covariance_.block<3, 3>(kRotationError, kPositionError) = pose.bottomLeftCorner<3, 3>();
  covariance_.block<3, 3>(kRotationError, kRotationError) = pose.bottomRightCorner<3, 3>();
  covariance_.block<3, 3>(kVelocityError, kVelocityError)
      .diagonal()
      .setConstant(velocity_sigma * velocity_sigma);
  covariance_.block<3, 3>(kSpinError, kSpinError).diagonal().setConstant(spin_sigma * spin_sigma);
  for (auto& camera : probation_) camera.fill(0);
  acquired_ = true;
  time_ = last_update_ = time;
  last_good_ = state_;
  agreement_ = 1.0;
  noise_.reset();
}

void PixelFilter::predictFeatures(const Observation& observation, const CameraEstimate& estimate,
                                  Features& features) const {
  const CameraModel& camera = cameras_[static_cast<std::size_t>(observation.camera.index())];
  const Eigen::Matrix3d camera_from_world = estimate.camera_from_world.rotation.toRotationMatrix();
  const Eigen::Matrix3d world_from_body = state_.world_from_body.rotation.toRotationMatrix();
  const Matrix6d pose_covariance = poseBlock(covariance_);
  for (int m = 0; m < markers_.count(); ++m) {
    Feature& feature = features[static_cast<std::size_t>(m)];
    const Eigen::Vector3d& marker = markers_.inBody(markerId(m));
    const Eigen::Vector3d in_camera = estimate.camera_from_world * (state_.world_from_body * marker);
    Eigen::Matrix<double, 2, 3> d_point;
    const auto pixel = camera.project(in_camera, &d_point);
    if (!pixel) continue;
    MarkerPrediction& prediction = feature.prediction;
    prediction.radius_px = camera.fx() * markers_.radius() / in_camera.z();
    prediction.pixel = *pixel;
    // Cut off at the image's edge, a ball's centre of gravity is not its centre.
    prediction.visible = camera.contains(*pixel, prediction.radius_px + 1.0);
    const Eigen::Matrix<double, 2, 3> d_world = d_point * camera_from_world;
    feature.d_pose.leftCols<3>() = d_world;
    feature.d_pose.rightCols<3>() = -d_world * world_from_body * hat(marker);
    feature.d_camera.leftCols<3>() = -d_point * hat(in_camera);
    feature.d_camera.rightCols<3>() = -d_world;
    prediction.covariance = feature.d_pose * pose_covariance * feature.d_pose.transpose() +
                            feature.d_camera * estimate.covariance * feature.d_camera.transpose();
    if (observation.count > 0) prediction.covariance += observation.centroids[0].covariance;
  }
}

void PixelFilter::nameFeatures(const Observation& observation, Features& features, CameraTrack& track) const {
  std::array<MarkerPrediction, kMaxMarkers> predictions;
  const auto count = static_cast<std::size_t>(markers_.count());
  for (std::size_t m = 0; m < count; ++m) {
    predictions[m] = features[m].prediction;
    // Partly hidden balls lie further off; their own covariance is applied below.
    const double allowance = 0.25 * predictions[m].radius_px;
    predictions[m].covariance.diagonal().array() += allowance * allowance;
  }
  const Names names = nameByPrediction({predictions.data(), count}, observation, options_.gate_chi2);
  for (std::size_t m = 0; m < count; ++m) {
    if (names[m] < 0) continue;
    const Centroid& centroid = observation.centroids[static_cast<std::size_t>(names[m])];
    Feature& feature = features[m];
    feature.innovation = centroid.pixel - feature.prediction.pixel;
    feature.noise = centroid.covariance;
    // Of a fitted disc the radius is known although a part is hidden, and its covariance says what that
    // costs.
    const double share = centroid.radius_px / feature.prediction.radius_px;
    const double missing = std::max(0.0, 1.0 - share * share);
    const double shift = kHiddenShift * missing * feature.prediction.radius_px;
    feature.noise.diagonal().array() += shift * shift;
    feature.selected = true;
    track.markers[m].observed = true;
    track.markers[m].pixel = centroid.pixel;
  }
}

void PixelFilter::select(CameraId camera, const CameraEstimate& estimate, Features& features) {
  const auto count = static_cast<std::size_t>(markers_.count());
  auto& probation = probation_[static_cast<std::size_t>(camera.index())];
  const Matrix6d pose_covariance = poseBlock(covariance_);
  for (std::size_t m = 0; m < count; ++m) {
    Feature& feature = features[m];
    if (!feature.selected) continue;
    const Eigen::Matrix2d s = feature.d_pose * pose_covariance * feature.d_pose.transpose() +
                              feature.d_camera * estimate.covariance * feature.d_camera.transpose() +
                              feature.noise;
    feature.agrees = feature.innovation.dot(s.ldlt().solve(feature.innovation)) < options_.gate_chi2;
    feature.selected = feature.agrees && probation[m] == 0;
    if (!feature.agrees)
      probation[m] = kProbation;
    else if (probation[m] > 0)
      --probation[m];
  }

  // The largest subset that passes jointly, by dropping the worst: markers of one helicopter must agree on
  // one motion.
  for (;;) {
    std::array<std::size_t, kMaxMarkers> chosen;
    int n = 0;
    for (std::size_t m = 0; m < count; ++m)
      if (features[m].selected) chosen[static_cast<std::size_t>(n++)] = m;
    if (n < 2) {
      // A single centroid in the gate may be anything green; two that agree with the pose are hardly chance.
      if (n == 1) features[chosen[0]].selected = false;
      break;
    }
    MeasurementMatrix s(2 * n, 2 * n);
    MeasurementVector r(2 * n);
    for (int a = 0; a < n; ++a) {
      const Feature& fa = features[chosen[static_cast<std::size_t>(a)]];
      r.segment<2>(2 * a) = fa.innovation;
      for (int b = 0; b < n; ++b) {
        const Feature& fb = features[chosen[static_cast<std::size_t>(b)]];
        s.block<2, 2>(2 * a, 2 * b) = fa.d_pose * pose_covariance * fb.d_pose.transpose() +
                                      fa.d_camera * estimate.covariance * fb.d_camera.transpose();
      }
      s.block<2, 2>(2 * a, 2 * a) += fa.noise;
    }
    const MeasurementVector weighted = s.llt().solve(r);
    if (r.dot(weighted) < kJointLimit[static_cast<std::size_t>(n - 1)]) break;
    int worst = 0;
    double worst_share = -1.0;
    for (int a = 0; a < n; ++a) {
      // Leaving a feature out lowers the joint statistic by w_a^T (S^-1)_aa^-1 w_a; its noise stands in for
      // that block.
      const Eigen::Vector2d w = weighted.segment<2>(2 * a);
      const double share = w.dot(features[chosen[static_cast<std::size_t>(a)]].noise * w);
      if (share > worst_share) {
        worst_share = share;
        worst = a;
      }
    }
    features[chosen[static_cast<std::size_t>(worst)]].selected = false;
    probation[chosen[static_cast<std::size_t>(worst)]] = kProbation;
  }
}

bool PixelFilter::correctWithinReach(const CameraEstimate& estimate, const Features& features, bool airborne) {
  const HelicopterState state = state_;
  const Matrix12d covariance = covariance_;
  if (!correct(estimate, features, airborne)) return false;
  if (isWithinReach(state_.world_from_body.translation, time_, airborne)) return true;
  state_ = state;
  covariance_ = covariance;
  return false;
}

bool PixelFilter::correct(const CameraEstimate& estimate, const Features& features, bool airborne) {
  int n = 0;
  MeasurementJacobian h(2 * kMaxMarkers, 12);
  CameraJacobian hc(2 * kMaxMarkers, 6);
  MeasurementVector r(2 * kMaxMarkers);
  MeasurementMatrix noise = MeasurementMatrix::Zero(2 * kMaxMarkers, 2 * kMaxMarkers);
  h.setZero();
  for (const Feature& feature : features) {
    if (!feature.selected) continue;
    h.block<2, 3>(2 * n, kPositionError) = feature.d_pose.leftCols<3>();
    h.block<2, 3>(2 * n, kRotationError) = feature.d_pose.rightCols<3>();
    hc.block<2, 6>(2 * n, 0) = feature.d_camera;
    r.segment<2>(2 * n) = feature.innovation;
    noise.block<2, 2>(2 * n, 2 * n) = feature.noise;
    ++n;
  }
  if (n == 0) return false;
  const int rows = 2 * n;
  const MeasurementJacobian hn = h.topRows(rows);
  MeasurementMatrix rn = noise.topLeftCorner(rows, rows);
  if (!estimate.covariance.isZero(0.0))
    rn += hc.topRows(rows) * estimate.covariance * hc.topRows(rows).transpose();

  const Eigen::Matrix<double, 12, Eigen::Dynamic, 0, 12, 2 * kMaxMarkers> ph = covariance_ * hn.transpose();
  const MeasurementMatrix s = hn * ph + rn;
  const Eigen::LLT<MeasurementMatrix> llt(s);
  if (llt.info() != Eigen::Success) return false;
  const Eigen::Matrix<double, 12, Eigen::Dynamic, 0, 12, 2 * kMaxMarkers> gain =
      llt.solve(ph.transpose()).transpose();
  const Eigen::Matrix<double, 12, 1> change = gain * r.head(rows);
  if (!change.allFinite()) return false;

  // What the corrections should amount to if the noise is right: the diagonal of K S K^T.
  const Eigen::Matrix<double, 12, 1> expected = (gain * ph.transpose()).diagonal();
  noise_.learn(change.segment<3>(kVelocityError), expected.segment<3>(kVelocityError),
               change.segment<3>(kSpinError), expected.segment<3>(kSpinError), airborne);
  state_.world_from_body.translation += change.segment<3>(kPositionError);
  state_.velocity_in_world += change.segment<3>(kVelocityError);
  state_.world_from_body.rotation =
      (state_.world_from_body.rotation * expSO3(change.segment<3>(kRotationError))).normalized();
  state_.angular_velocity_in_body += change.segment<3>(kSpinError);
  // Joseph's form: stays positive definite over hours.
  const Matrix12d remain = Matrix12d::Identity() - gain * hn;
  covariance_ = remain * covariance_ * remain.transpose() + gain * rn * gain.transpose();
  return true;
}

void PixelFilter::report(const Observation& observation, const CameraEstimate& estimate,
                         const Features& features, CameraTrack& track) const {
  const CameraModel& camera = cameras_[static_cast<std::size_t>(observation.camera.index())];
  double cost = 0.0;
  for (int m = 0; m < markers_.count(); ++m) {
    MarkerTrack& marker = track.markers[static_cast<std::size_t>(m)];
    const auto pixel =
        camera.project(estimate.camera_from_world * (state_.world_from_body * markers_.inBody(markerId(m))));
    marker.predicted = pixel.has_value();
    if (pixel) marker.reprojected = *pixel;
    const Feature& feature = features[static_cast<std::size_t>(m)];
    marker.agrees = feature.agrees;
    marker.selected = feature.selected;
    track.predicted_count += feature.prediction.visible;
    track.agreeing_count += feature.agrees;
    if (!marker.selected || !pixel) continue;
    ++track.selected_count;
    cost += (marker.pixel - *pixel).squaredNorm();
  }
  if (track.selected_count > 0) track.residual_px = std::sqrt(cost / (2.0 * track.selected_count));
}

}  // namespace helical
