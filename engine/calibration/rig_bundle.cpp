#include "engine/calibration/rig_bundle.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <string>

#include "engine/base/check.h"
#include "engine/base/error.h"
#include "engine/geometry/camera_perturbation.h"

namespace helical {
namespace {

constexpr int kPoseIterations = 3;
constexpr double kSettledPose = 1e-8;
constexpr double kUnseenCost = 1e6;       // squared sigmas, where a ball would be behind the camera
constexpr double kMedianToScale = 2.5;    // 1.18 sigma is the median of a good fit: stays below the scale
constexpr double kMedianOfTwo = 1.1774;
constexpr double kSmallDecrease = 0.02;   // squared sigmas: a hundredth of a standard deviation
constexpr double kSmallStep = 1e-8;
constexpr double kHugeStep = 100.0;
constexpr double kMostDamping = 1e8;
constexpr int kRigidFreedoms = 6;         // of the balls as a whole
constexpr double kExact = 1e-14;          // variance below which a given pose is no unknown

RigidTransform movedBody(const RigidTransform& world_from_body, const Vector6d& step) {
  RigidTransform moved = world_from_body;
  moved.translation += step.head<3>();
  moved.rotation = (moved.rotation * expSO3(step.tail<3>())).normalized();
  return moved;
}

}  // namespace

void validate(const RigBundleOptions& options) {
  const auto require = [](bool good, const char* key, double value, const char* cure) {
    if (!good)
      throw Error(ErrorKind::kInput, std::string(key) + " of a rig's refinement is " + std::to_string(value), {}, cure);
  };
  require(options.iterations >= 1 && options.iterations <= 1000, "iterations", options.iterations, "give 1 to 1000");
  require(options.robust_sigmas >= 1.0 && options.robust_sigmas <= 1000.0, "robust_sigmas", options.robust_sigmas,
          "give 1 to 1000");
  require(options.marker_sigma_m >= 0.0 && options.marker_sigma_m <= 1.0, "marker_sigma_m", options.marker_sigma_m,
          "give 0 to 1 m");
  require(options.focal_sigma >= 0.0 && options.focal_sigma <= 1.0, "focal_sigma", options.focal_sigma,
          "give 0 to 1");
}

void RigBundle::Sum::clear() {
  hessian.setZero();
  gradient.setZero();
  cost = median_sigmas = 0.0;
  balls.fill(0);
  inliers.fill(0);
  seen.fill(0);
  fitting.fill(0);
}

RigBundle::RigBundle(std::vector<CameraModel> cameras, const MarkerLayout& markers, int moments)
    : models_(std::move(cameras)), layout_(markers), initial_layout_(markers) {
  poses_.resize(static_cast<std::size_t>(moments));
  cameras_.resize(models_.size());
  given_.resize(models_.size());
  const auto most = static_cast<Eigen::Index>(7 * models_.size() + 3 * static_cast<std::size_t>(markers.count()));
  for (Sum* sum : {&current_, &sum_}) {
    sum->hessian.resize(most, most);
    sum->gradient.resize(most);
  }
  coupling_.resize(6, most);
  step_.resize(most);
  factor_.resize(most, most);
  inverse_.resize(most, most);
  distances_.reserve(static_cast<std::size_t>(moments) * models_.size() * static_cast<std::size_t>(markers.count()));
}

void RigBundle::start(std::span<RigMoment> moments, std::span<const BundleCamera> cameras,
                      const RigBundleOptions& options) {
  HELICAL_CHECK(moments.size() <= poses_.size() && cameras.size() == models_.size());
  validate(options);
  layout_ = initial_layout_;
  moments_ = moments;
  options_ = options;
  std::copy(cameras.begin(), cameras.end(), cameras_.begin());
  given_ = cameras_;
  for (std::size_t i = 0; i < moments_.size(); ++i) poses_[i] = moments_[i].world_from_body;
  for (std::size_t c = 0; c < models_.size(); ++c) {
    best_.cameras[c] = cameras_[c].camera_from_world;
    best_.focal_scales[c] = cameras_[c].focal_scale;
  }
  std::copy(initial_layout_.all().begin(), initial_layout_.all().end(), best_.markers.begin());
  layOut();
  damping_ = 1e-3;
  scale_ = options_.robust_sigmas;
  iteration_ = 0;
  first_ = true;
  beginPass(best_);
}

/// Which unknown has which column.
void RigBundle::layOut() {
  columns_ = 0;
  camera_column_.fill(-1);
  focal_column_.fill(-1);
  for (std::size_t c = 0; c < models_.size(); ++c) {
    if (!cameras_[c].used) continue;
    if (!cameras_[c].given || cameras_[c].covariance.diagonal().maxCoeff() > kExact) {
      camera_column_[c] = columns_;
      columns_ += 6;
    }
  }
  moved_column_ = columns_;
  for (std::size_t c = 0; c < models_.size(); ++c)
    if (cameras_[c].used && !cameras_[c].focal_is_given && options_.focal_sigma > 0.0) focal_column_[c] = columns_++;
  freedoms_ = columns_ - moved_column_;
  marker_column_ = options_.marker_sigma_m > 0.0 ? columns_ : -1;
  if (marker_column_ >= 0) freedoms_ += 3 * layout_.count() - kRigidFreedoms;
  if (marker_column_ >= 0) columns_ += 3 * layout_.count();
  current_.clear();
  step_.setZero();
}

void RigBundle::beginPass(const Parameters& parameters) {
  trial_ = parameters;
  next_ = 0;
  sum_.clear();
  distances_.clear();
  for (std::size_t i = 0; i < moments_.size(); ++i) moments_[i].world_from_body = poses_[i];
  state_ = State::kEvaluating;
}

bool RigBundle::advance(int moments) {
  for (; running() && moments > 0; --moments) {
    if (next_ < moments_.size()) add(moments_[next_++]);
    if (next_ == moments_.size()) endPass();
  }
  return !running();
}

std::optional<RigBundle::Term> RigBundle::project(std::size_t camera, int marker, const RigMoment& moment,
                                                  bool derivatives) const {
  const auto m = static_cast<std::size_t>(marker);
  const RigidTransform& camera_from_world = trial_.cameras[camera];
  const Eigen::Vector3d in_camera = camera_from_world * (moment.world_from_body * trial_.markers[m]);
  Eigen::Matrix<double, 2, 3> d_point;
  const auto pixel = models_[camera].project(in_camera, &d_point);
  if (!pixel) return std::nullopt;
  const double scale = trial_.focal_scales[camera];
  const Eigen::Vector2d from_centre = *pixel - Eigen::Vector2d(models_[camera].cx(), models_[camera].cy());
  Term term;
  term.residual = *pixel + (scale - 1.0) * from_centre - moment.views[camera].pixels[m].cast<double>();
  const Eigen::Matrix<double, 2, 3> d_world = scale * d_point * camera_from_world.rotation.toRotationMatrix();
  const Eigen::Matrix3d body = moment.world_from_body.rotation.toRotationMatrix();
  term.d_pose.leftCols<3>() = d_world;
  term.d_marker = d_world * body;
  term.d_pose.rightCols<3>() = -term.d_marker * hat(trial_.markers[m]);
  if (!derivatives) return term;
  term.d_camera.leftCols<3>() = -scale * d_point * hat(in_camera);
  term.d_camera.rightCols<3>() = -d_world;
  term.d_focal = from_centre;
  return term;
}

double RigBundle::weight(double squared, double& cost) const {
  const double limit = scale_ * scale_;
  if (squared <= limit) {
    cost += squared;
    return 1.0;
  }
  const double ratio = limit / squared;
  cost += limit * (2.0 - ratio);
  return ratio * ratio;
}

/// The helicopter's pose that fits best under the parameters.
void RigBundle::fitPose(RigMoment& moment) const {
  if (moment.pose_is_given) return;
  for (int iteration = 0; iteration < kPoseIterations; ++iteration) {
    Matrix6d hessian = 1e-9 * Matrix6d::Identity();
    Vector6d gradient = Vector6d::Zero();
    double cost = 0.0;
    for (std::size_t c = 0; c < models_.size(); ++c) {
      if (!cameras_[c].used) continue;
      const RigMoment::View& view = moment.views[c];
      for (int m = 0; m < layout_.count(); ++m) {
        if (!view.seen[static_cast<std::size_t>(m)]) continue;
        const auto term = project(c, m, moment, false);
        if (!term) continue;
        const double information = 1.0 / view.variance;
        const double weighted =
            information * weight(information * term->residual.squaredNorm(), cost);
        hessian.noalias() += weighted * term->d_pose.transpose() * term->d_pose;
        gradient.noalias() += weighted * term->d_pose.transpose() * term->residual;
      }
    }
    const Vector6d step = -hessian.ldlt().solve(gradient);
    if (!step.allFinite() || step.norm() > 1.0) return;
    moment.world_from_body = movedBody(moment.world_from_body, step);
    if (step.squaredNorm() < kSettledPose) return;
  }
}

void RigBundle::add(RigMoment& moment) {
  fitPose(moment);
  Matrix6d pose_pose = 1e-9 * Matrix6d::Identity();
  Vector6d pose_gradient = Vector6d::Zero();
  coupling_.setZero();
  for (std::size_t c = 0; c < models_.size(); ++c) {
    if (!cameras_[c].used) continue;
    const RigMoment::View& view = moment.views[c];
    for (int m = 0; m < layout_.count(); ++m) {
      if (!view.seen[static_cast<std::size_t>(m)]) continue;
      ++sum_.balls[c];
      ++sum_.seen[static_cast<std::size_t>(m)];
      const auto term = project(c, m, moment, true);
      if (!term) {
        sum_.cost += kUnseenCost;
        continue;
      }
      const double information = 1.0 / view.variance;
      const double squared = information * term->residual.squaredNorm();
      const double weighted = information * weight(squared, sum_.cost);
      const bool fits = squared <= scale_ * scale_;
      sum_.inliers[c] += fits;
      sum_.fitting[static_cast<std::size_t>(m)] += fits;
      if (distances_.size() < distances_.capacity()) distances_.push_back(static_cast<float>(squared));
      // All derivatives of this term in the columns that it touches.
      struct Block {
        int column;
        Eigen::Matrix<double, 2, 6> values;
        int width;
      };
      std::array<Block, 3> blocks;
      std::size_t count = 0;
      if (camera_column_[c] >= 0) blocks[count++] = {camera_column_[c], term->d_camera, 6};
      if (focal_column_[c] >= 0) {
        Block& block = blocks[count++];
        block = {focal_column_[c], Eigen::Matrix<double, 2, 6>::Zero(), 1};
        block.values.col(0) = term->d_focal;
      }
      if (marker_column_ >= 0) {
        Block& block = blocks[count++];
        block = {marker_column_ + 3 * m, Eigen::Matrix<double, 2, 6>::Zero(), 3};
        block.values.leftCols<3>() = term->d_marker;
      }
      for (std::size_t a = 0; a < count; ++a) {
        const auto left = blocks[a].values.leftCols(blocks[a].width);
        sum_.gradient.segment(blocks[a].column, blocks[a].width).noalias() +=
            weighted * left.transpose() * term->residual;
        coupling_.middleCols(blocks[a].column, blocks[a].width).noalias() +=
            weighted * term->d_pose.transpose() * left;
        for (std::size_t b = 0; b < count; ++b)
          sum_.hessian.block(blocks[a].column, blocks[b].column, blocks[a].width, blocks[b].width).noalias() +=
              weighted * left.transpose() * blocks[b].values.leftCols(blocks[b].width);
      }
      pose_pose.noalias() += weighted * term->d_pose.transpose() * term->d_pose;
      pose_gradient.noalias() += weighted * term->d_pose.transpose() * term->residual;
    }
  }
  if (moment.pose_is_given || columns_ == 0) return;
  const Eigen::LLT<Matrix6d> root(pose_pose);
  if (root.info() != Eigen::Success) return;
  const Vector6d absorbed_gradient = root.matrixL().solve(pose_gradient);
  auto absorbed = coupling_.leftCols(columns_);
  root.matrixL().solveInPlace(absorbed);
  for (int column = 0; column < columns_; ++column)
    sum_.hessian.col(column).head(columns_).noalias() -= absorbed.transpose() * absorbed.col(column);
  sum_.gradient.head(columns_).noalias() -= absorbed.transpose() * absorbed_gradient;
}

void RigBundle::addPriors() {
  for (std::size_t c = 0; c < models_.size(); ++c) {
    if (camera_column_[c] >= 0 && given_[c].given) {
      const Matrix6d information =
          (given_[c].covariance + kExact * Matrix6d::Identity()).inverse();
      const Vector6d off = cameraPerturbation(given_[c].camera_from_world, trial_.cameras[c]);
      sum_.hessian.block<6, 6>(camera_column_[c], camera_column_[c]) += information;
      sum_.gradient.segment<6>(camera_column_[c]) += information * off;
      sum_.cost += off.dot(information * off);
    }
    if (focal_column_[c] >= 0) {
      const double information = 1.0 / (options_.focal_sigma * options_.focal_sigma);
      const double off = trial_.focal_scales[c] - given_[c].focal_scale;
      sum_.hessian(focal_column_[c], focal_column_[c]) += information;
      sum_.gradient[focal_column_[c]] += information * off;
      sum_.cost += information * off * off;
    }
  }
  if (marker_column_ < 0) return;
  const double information = 1.0 / (options_.marker_sigma_m * options_.marker_sigma_m);
  for (int m = 0; m < layout_.count(); ++m) {
    const Eigen::Vector3d off = trial_.markers[static_cast<std::size_t>(m)] - initial_layout_.inBody(markerId(m));
    sum_.hessian.diagonal().segment<3>(marker_column_ + 3 * m).array() += information;
    sum_.gradient.segment<3>(marker_column_ + 3 * m) += information * off;
    sum_.cost += information * off.squaredNorm();
  }
}

void RigBundle::endPass() {
  addPriors();
  if (!distances_.empty()) {
    const auto middle = distances_.begin() + static_cast<std::ptrdiff_t>(distances_.size() / 2);
    std::nth_element(distances_.begin(), middle, distances_.end());
    sum_.median_sigmas = std::sqrt(static_cast<double>(*middle));
  }
  if (!first_ && !(sum_.cost < current_.cost)) {
    damping_ = std::max(8.0 * damping_, 1e-6);
    if (damping_ > kMostDamping || step_.head(columns_).norm() < kSmallStep || sum_.cost - current_.cost < kSmallDecrease) return finish();
    return propose();
  }
  const double decrease = first_ ? kUnseenCost : current_.cost - sum_.cost;
  if (!first_) damping_ *= 0.2;
  best_ = trial_;
  std::swap(current_, sum_);
  for (std::size_t i = 0; i < moments_.size(); ++i) poses_[i] = moments_[i].world_from_body;
  const double wanted = std::max(options_.robust_sigmas, kMedianToScale * current_.median_sigmas);
  first_ = std::abs(wanted - scale_) > 0.05 * scale_;
  if (first_ && iteration_ < options_.iterations) {
    scale_ = wanted;  // costs at another scale do not compare: the same parameters once more
    ++iteration_;
    return beginPass(best_);
  }
  first_ = false;
  if (decrease < kSmallDecrease) return finish();
  propose();
}

void RigBundle::propose() {
  if (columns_ == 0 || iteration_++ >= options_.iterations) return finish();
  auto step = step_.head(columns_);
  step = -current_.gradient.head(columns_);
  while (!factorise(damping_) && damping_ < kMostDamping) damping_ = std::max(8.0 * damping_, 1e-6);
  if (damping_ < kMostDamping) {
    factor_.topLeftCorner(columns_, columns_).triangularView<Eigen::Lower>().solveInPlace(step);
    factor_.topLeftCorner(columns_, columns_).triangularView<Eigen::Lower>().transpose().solveInPlace(step);
  }
  if (!step.allFinite() || step.norm() > kHugeStep) {
    state_ = State::kFailed;
    return;
  }
  Parameters next = best_;
  for (std::size_t c = 0; c < models_.size(); ++c) {
    if (camera_column_[c] >= 0)
      next.cameras[c] = perturbCamera(best_.cameras[c], step_.segment<6>(camera_column_[c]));
    if (focal_column_[c] >= 0)
      next.focal_scales[c] = std::clamp(best_.focal_scales[c] + step_[focal_column_[c]], 0.2, 5.0);
  }
  if (marker_column_ >= 0)
    for (int m = 0; m < layout_.count(); ++m)
      next.markers[static_cast<std::size_t>(m)] += step_.segment<3>(marker_column_ + 3 * m);
  beginPass(next);
}

bool RigBundle::factorise(double damping) {
  auto matrix = factor_.topLeftCorner(columns_, columns_);
  matrix = current_.hessian.topLeftCorner(columns_, columns_);
  matrix.diagonal() *= 1.0 + damping;
  for (int k = 0; k < columns_; ++k) {
    const double pivot = matrix(k, k) - matrix.row(k).head(k).squaredNorm();
    if (!(pivot > 1e-12 * std::abs(current_.hessian(k, k)))) return false;
    matrix(k, k) = std::sqrt(pivot);
    for (int i = k + 1; i < columns_; ++i)
      matrix(i, k) = (matrix(i, k) - matrix.row(i).head(k).dot(matrix.row(k).head(k))) / matrix(k, k);
  }
  return true;
}

void RigBundle::finish() {
  for (std::size_t i = 0; i < moments_.size(); ++i) moments_[i].world_from_body = poses_[i];
  const bool determined = factorise(0.0);
  state_ = determined ? State::kDone : State::kFailed;
  if (!determined) return;
  auto covariance = inverse_.topLeftCorner(columns_, columns_);
  covariance.setIdentity();
  const auto root = factor_.topLeftCorner(columns_, columns_).triangularView<Eigen::Lower>();
  for (int column = 0; column < columns_; ++column) {
    auto unit = covariance.col(column);
    root.solveInPlace(unit);
    root.transpose().solveInPlace(unit);
  }
  // Where even the answer fits badly, sigma was too small.
  misfit_ = std::max(1.0, std::pow(current_.median_sigmas / kMedianOfTwo, 2));
  for (std::size_t c = 0; c < models_.size(); ++c) {
    BundleCamera& camera = cameras_[c];
    camera.balls = current_.balls[c];
    camera.inliers = current_.inliers[c];
    camera.camera_from_world = best_.cameras[c];
    camera.focal_scale = best_.focal_scales[c];
    if (camera_column_[c] >= 0)
      camera.covariance = misfit_ * covariance.block<6, 6>(camera_column_[c], camera_column_[c]);
    if (focal_column_[c] >= 0)
      camera.focal_sigma = std::sqrt(misfit_ * covariance(focal_column_[c], focal_column_[c]));
  }
  if (marker_column_ < 0) return;
  layout_ = MarkerLayout({best_.markers.data(), static_cast<std::size_t>(initial_layout_.count())},
                         initial_layout_.radius());
}

/// With the other parameters at their best for each, the cost is a quadratic form of these: that of the
/// factor's lower right corner.
double RigBundle::gainOver(const MarkerLayout& balls, std::span<const double> focal_scales) const {
  const int moved = columns_ - moved_column_;
  std::array<double, kMaxCameras + 3 * kMaxMarkers> shifts;
  Eigen::Map<Eigen::VectorXd> shift(shifts.data(), moved);
  for (std::size_t c = 0; c < models_.size(); ++c)
    if (focal_column_[c] >= 0)
      shift[focal_column_[c] - moved_column_] = best_.focal_scales[c] - focal_scales[c];
  if (marker_column_ >= 0)
    for (int m = 0; m < layout_.count(); ++m)
      shift.segment<3>(marker_column_ - moved_column_ + 3 * m) =
          best_.markers[static_cast<std::size_t>(m)] - balls.inBody(markerId(m));
  double gain = 0.0;
  for (int column = 0; column < moved; ++column) {
    const auto below = factor_.col(moved_column_ + column).segment(moved_column_ + column, moved - column);
    gain += std::pow(below.dot(shift.tail(moved - column)), 2) / misfit_;
  }
  return gain;
}

double RigBundle::fitting(MarkerId ball) const {
  const auto m = static_cast<std::size_t>(ball.index());
  return current_.seen[m] > 0 ? static_cast<double>(current_.fitting[m]) / current_.seen[m] : 1.0;
}

}  // namespace helical
