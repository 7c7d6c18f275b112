#include "engine/calibration/rig/rig_bundle.h"

#include <ceres/ceres.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <vector>

#include "engine/calibration/rig/camera_delays.h"
#include "engine/calibration/rig/sighting_derivatives.h"
#include "engine/geometry/camera_perturbation.h"
#include "engine/geometry/quiet_ceres.h"

namespace helical {
namespace {

constexpr double kLongestStep = 0.3;  // periods that a delay changes by at once: beyond, the parabola guesses
constexpr double kRobustKeeps = 0.83;  // of the squares of Gaussian noise, Cauchy's loss at three sigmas
constexpr double kTellingSigmas = 3.0;
constexpr double kGivenFocal = 1.0;  // a scale

constexpr double kUnseenPx = 1000.0;      // stands for a point which the camera model cannot project
using PoseBlock = std::array<double, 7>;  ///< quaternion x y z w, translation

RigidTransform toTransform(const double* block) {
  return {Eigen::Map<const Eigen::Quaterniond>(block), Eigen::Map<const Eigen::Vector3d>(block + 4)};
}

void store(const RigidTransform& transform, double* block) {
  Eigen::Map<Eigen::Quaterniond>{block} = transform.rotation;
  Eigen::Map<Eigen::Vector3d>(block + 4) = transform.translation;
}

/// The six numbers of a pose's perturbation. Costs give their derivatives by those in the first six columns
/// of the block's seven, which PlusJacobian picks out.
class PoseManifold : public ceres::Manifold {
 public:
  int AmbientSize() const final { return 7; }
  int TangentSize() const final { return 6; }
  bool PlusJacobian(const double*, double* jacobian) const final {
    Eigen::Map<Eigen::Matrix<double, 7, 6, Eigen::RowMajor>>(jacobian).setIdentity();
    return true;
  }
  bool MinusJacobian(const double*, double* jacobian) const final {
    Eigen::Map<Eigen::Matrix<double, 6, 7, Eigen::RowMajor>>(jacobian).setIdentity();
    return true;
  }
};

class CameraManifold final : public PoseManifold {
 public:
  bool Plus(const double* x, const double* delta, double* moved) const override {
    store(perturbCamera(toTransform(x), Eigen::Map<const Vector6d>(delta)), moved);
    return true;
  }
  bool Minus(const double* y, const double* x, double* delta) const override {
    Eigen::Map<Vector6d>{delta} = cameraPerturbation(toTransform(x), toTransform(y));
    return true;
  }
};

class BodyManifold final : public PoseManifold {
 public:
  bool Plus(const double* x, const double* delta, double* moved) const override {
    const RigidTransform pose = toTransform(x);
    const Eigen::Map<const Vector6d> d(delta);
    store({(expSO3(d.head<3>()) * pose.rotation).normalized(), pose.translation + d.tail<3>()}, moved);
    return true;
  }
  bool Minus(const double* y, const double* x, double* delta) const override {
    const RigidTransform to = toTransform(y), from = toTransform(x);
    Eigen::Map<Vector6d> d(delta);
    d.head<3>() = logSO3(to.rotation * from.rotation.conjugate());
    d.tail<3>() = to.translation - from.translation;
    return true;
  }
};

/// Of a point that the camera model cannot project.
const Eigen::Matrix<double, 2, 3> kNoSlope = Eigen::Matrix<double, 2, 3>::Zero();

/// Derivatives of a pixel by the first of a block's numbers; zero by the others. Null: nobody asks.
template <int kUsed, int kSize>
void putDerivatives(const Eigen::Matrix<double, 2, kUsed>& values, double* jacobian) {
  if (jacobian == nullptr) return;
  Eigen::Map<Eigen::Matrix<double, 2, kSize, Eigen::RowMajor>> out(jacobian);
  out.setZero();
  out.template leftCols<kUsed>() = values;
}

/// Predicted less seen pixel of a body's point under a focal length that is the camera's times a scale.
/// Parameters: camera, the body's pose, the point in the body, the scale.
class FreeBodyCost final : public ceres::SizedCostFunction<2, 7, 7, 3, 1> {
 public:
  FreeBodyCost(const CameraModel& camera, const Eigen::Vector2d& pixel) : camera_(camera), seen_(pixel) {}

  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override {
    const RigidTransform camera_from_world = toTransform(parameters[0]),
                         world_from_body = toTransform(parameters[1]);
    const Eigen::Vector3d arm = world_from_body.rotation * Eigen::Map<const Eigen::Vector3d>(parameters[2]);
    const Eigen::Vector3d point = arm + world_from_body.translation;
    const double scale = *parameters[3];
    Eigen::Matrix<double, 2, 3> d_pixel;
    const auto pixel = camera_.project(camera_from_world * point, &d_pixel);
    Eigen::Vector2d from_centre = Eigen::Vector2d::Zero();
    if (pixel) from_centre = *pixel - Eigen::Vector2d(camera_.cx(), camera_.cy());
    Eigen::Map<Eigen::Vector2d>{residuals} =
        pixel ? (*pixel + (scale - 1.0) * from_centre - seen_).eval() : Eigen::Vector2d::Constant(kUnseenPx);
    if (jacobians == nullptr) return true;
    const SightingDerivatives d =
        sightingDerivatives(camera_from_world, point, arm, pixel ? (scale * d_pixel).eval() : kNoSlope);
    putDerivatives<6, 7>(d.camera, jacobians[0]);
    putDerivatives<6, 7>(d.body, jacobians[1]);
    putDerivatives<3, 3>(d.point * world_from_body.rotation.toRotationMatrix(), jacobians[2]);
    if (jacobians[3] != nullptr) Eigen::Map<Eigen::Vector2d>{jacobians[3]} = from_centre;
    return true;
  }

 private:
  const CameraModel& camera_;
  Eigen::Vector2d seen_;
};

/// Holds numbers near what was given.
template <int kSize>
class PriorCost final : public ceres::SizedCostFunction<kSize, kSize> {
 public:
  PriorCost(const double* given, double weight) : given_(given), weight_(weight) {}

  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override {
    using Vector = Eigen::Matrix<double, kSize, 1>;
    Eigen::Map<Vector>{residuals} = weight_ * (Eigen::Map<const Vector>(parameters[0]) - given_);
    if (jacobians == nullptr || jacobians[0] == nullptr) return true;
    Eigen::Map<Eigen::Matrix<double, kSize, kSize>>{jacobians[0]} =
        weight_ * Eigen::Matrix<double, kSize, kSize>::Identity();
    return true;
  }

 private:
  Eigen::Map<const Eigen::Matrix<double, kSize, 1>> given_;
  double weight_;
};

/// Predicted less seen pixel, where it was when the table says. Parameters: camera, the point or the body's
/// pose, how much later the camera saw.
template <int kItemSize>
class SightingCost final : public ceres::SizedCostFunction<2, 7, kItemSize, 1> {
 public:
  SightingCost(const CameraModel& camera, const Sighting& sighting) : camera_(camera), sighting_(sighting) {}

  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override {
    constexpr bool kIsBody = kItemSize == 7;
    const RigidTransform camera_from_world = toTransform(parameters[0]);
    Eigen::Vector3d point, arm = Eigen::Vector3d::Zero();
    if constexpr (kIsBody) {
      const RigidTransform world_from_body = toTransform(parameters[1]);
      arm = world_from_body.rotation * sighting_.in_body;
      point = arm + world_from_body.translation;
    } else {
      point = Eigen::Map<const Eigen::Vector3d>(parameters[1]);
    }
    Eigen::Matrix<double, 2, 3> d_pixel;
    const auto pixel = camera_.project(camera_from_world * point, &d_pixel);
    const double late = parameters[2][0];
    const PixelMotion& motion = sighting_.motion;
    Eigen::Map<Eigen::Vector2d>{residuals} =
        pixel ? (*pixel - pixelBefore(sighting_, late)).eval() : Eigen::Vector2d::Constant(kUnseenPx);
    if (jacobians == nullptr) return true;
    const SightingDerivatives d =
        sightingDerivatives(camera_from_world, point, arm, pixel ? d_pixel : kNoSlope);
    putDerivatives<6, 7>(d.camera, jacobians[0]);
    if constexpr (kIsBody)
      putDerivatives<6, 7>(d.body, jacobians[1]);
    else
      putDerivatives<3, 3>(d.point, jacobians[1]);
    if (jacobians[2] != nullptr) {
      Eigen::Map<Eigen::Vector2d> out(jacobians[2]);
      out.setZero();
      if (pixel) out = motion.velocity - late * motion.acceleration;
    }
    return true;
  }

 private:
  const CameraModel& camera_;
  const Sighting& sighting_;
};

/// Holds the distance of a camera from a point: the scale that points alone leave open. Without it the normal
/// equations are singular. Nothing pulls against it, so that its weight does not matter.
class ScaleCost final : public ceres::SizedCostFunction<1, 7> {
 public:
  ScaleCost(const Eigen::Vector3d& from, double distance) : from_(from), distance_(distance) {}

  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override {
    const Eigen::Vector3d apart = toTransform(parameters[0]).inverseTranslation() - from_;
    residuals[0] = kWeightPx * (apart.norm() / distance_ - 1.0);
    if (jacobians == nullptr || jacobians[0] == nullptr) return true;
    Eigen::Map<Eigen::Matrix<double, 1, 7, Eigen::RowMajor>> out(jacobians[0]);
    out.setZero();
    out.segment<3>(3) = (kWeightPx / distance_) * apart.normalized().transpose();
    return true;
  }

 private:
  static constexpr double kWeightPx = 100.0;
  Eigen::Vector3d from_;
  double distance_;
};

/// Takes back what a delay gains by averaging noise: see noiseAfterDelay().
class AveragingCost final : public ceres::SizedCostFunction<1, 1> {
 public:
  /// `residuals`: about how many of the camera's own.
  AveragingCost(const SightingTable& table, std::size_t camera, double residuals, double sigma_px)
      : table_(table),
        camera_(camera),
        weight_(std::sqrt(std::max(1.0, residuals)) * std::max(kLeastSigmaPx, sigma_px)) {}

  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override {
    const double total = table_.late_s[camera_] + parameters[0][0];
    const DelayNoise noise = noiseAfterDelay(table_.timing, total / table_.period_s);
    const double left = std::max(kLeastLeft, kMostNoise - noise.variance);
    residuals[0] = weight_ * std::sqrt(left);
    if (jacobians != nullptr && jacobians[0] != nullptr)
      jacobians[0][0] =
          left > kLeastLeft ? -0.5 * weight_ * noise.slope / (std::sqrt(left) * table_.period_s) : 0.0;
    return true;
  }

 private:
  static constexpr double kMostNoise = 20.0, kLeastLeft = 1e-3;
  static constexpr double kLeastSigmaPx = 1e-3;
  const SightingTable& table_;
  std::size_t camera_;
  double weight_;
};

class Bundle {
 public:
  Bundle(RigState& state, std::span<const RigCamera> cameras, const SightingTable& table,
         const BundleOptions& options)
      : state_(state),
        table_(table),
        options_(options),
        body_(table.kind == TargetKind::kBody),
        camera_blocks_(cameras.size()),
        item_blocks_(static_cast<std::size_t>(table.items)),
        late_blocks_(cameras.size(), 0.0),
        ordering_(std::make_shared<ceres::ParameterBlockOrdering>()) {
    if (options.robust_scale_px > 0.0) loss_ = std::make_unique<ceres::CauchyLoss>(options.robust_scale_px);
    if (options.free_body != nullptr) {
      points_ = options.free_body->points;
      focal_scales_ = options.free_body->focal_scales;
    }
    for (std::size_t row = 0; row < table.sightings.size(); ++row) addSighting(cameras, row);
    if (options.free_body != nullptr) holdNearGiven();
    if (options_.late_s != nullptr && options_.take_back_averaging) takeBackAveraging();
    if (options_.late_s != nullptr) holdDelaysOfStillViews();
    holdGauge();
  }

  double solve() {
    if (problem_.NumResidualBlocks() == 0) return 0.0;
    ceres::Solver::Options solver;
    solver.linear_solver_type = ceres::DENSE_SCHUR;
    solver.linear_solver_ordering = ordering_;
    solver.max_num_iterations = options_.max_iterations;
    solver.function_tolerance = 1e-9;
    solver.num_threads = 1;  // the order of sums, and with it the last bit, depends on it
    solver.logging_type = ceres::SILENT;
    ceres::Solver::Summary summary;
    quietCeres();
    ceres::Solve(solver, &problem_, &summary);
    if (summary.IsSolutionUsable()) takeOver();
    return 2.0 * summary.final_cost;
  }

 private:
  void addSighting(std::span<const RigCamera> cameras, std::size_t row) {
    const Sighting& s = table_.sightings[row];
    const auto c = static_cast<std::size_t>(s.camera), i = static_cast<std::size_t>(s.item);
    const bool known = body_ ? state_.world_from_body[i].has_value() : state_.points[i].has_value();
    if (!s.inlier || !known || !state_.camera_from_world[c]) return;
    if (options_.late_s != nullptr && !s.motion.known) return;  // would say that nothing is late
    double *camera = camera_blocks_[c].data(), *item = item_blocks_[i].data();
    if (!problem_.HasParameterBlock(camera)) {
      store(*state_.camera_from_world[c], camera);
      problem_.AddParameterBlock(camera, 7, &camera_manifold_);
      ordering_->AddElementToGroup(camera, 1);
      if (state_.fixed[c]) problem_.SetParameterBlockConstant(camera);
      addDelay(&late_blocks_[c]);
    }
    if (!problem_.HasParameterBlock(item)) {
      if (body_)
        store(*state_.world_from_body[i], item);
      else
        Eigen::Map<Eigen::Vector3d>{item} = *state_.points[i];
      problem_.AddParameterBlock(item, body_ ? 7 : 3, body_ ? &body_manifold_ : nullptr);
      ordering_->AddElementToGroup(item, 0);
      if (options_.only_cameras) problem_.SetParameterBlockConstant(item);
    }
    if (const FreeBody* body = options_.free_body) {
      double* point = points_[static_cast<std::size_t>(body->point[row])].data();
      auto* cost = new FreeBodyCost(body->given_cameras[c].model, s.pixel);
      problem_.AddResidualBlock(cost, loss_.get(), camera, item, point, &focal_scales_[c]);
      return;
    }
    ceres::CostFunction* cost = nullptr;
    if (body_)
      cost = new SightingCost<7>(cameras[c].model, s);
    else
      cost = new SightingCost<3>(cameras[c].model, s);
    problem_.AddResidualBlock(cost, loss_.get(), camera, item, &late_blocks_[c]);
  }

  void addDelay(double* late) {
    problem_.AddParameterBlock(late, 1);
    ordering_->AddElementToGroup(late, 1);
    if (options_.late_s == nullptr) return problem_.SetParameterBlockConstant(late);
    const double total = table_.late_s[static_cast<std::size_t>(late - late_blocks_.data())];
    const double step = kLongestStep * table_.period_s, reach = kDelayReachPeriods * table_.period_s;
    problem_.SetParameterLowerBound(late, 0, std::min(0.0, std::max(-step, -reach - total)));
    problem_.SetParameterUpperBound(late, 0, std::max(0.0, std::min(step, reach - total)));
  }

  void takeBackAveraging() {
    std::vector<double> residuals(camera_blocks_.size(), 0.0);
    for (const Sighting& s : table_.sightings)
      if (s.inlier && s.motion.known) residuals[static_cast<std::size_t>(s.camera)] += 2.0;
    const double share = kRobustKeeps * freeShare(table_);
    for (std::size_t c = 0; c < camera_blocks_.size(); ++c)
      if (problem_.HasParameterBlock(&late_blocks_[c]))
        problem_.AddResidualBlock(new AveragingCost(table_, c, share * residuals[c], options_.sigma_px),
                                  nullptr, &late_blocks_[c]);
  }

  /// What hardly moves in a period tells of no delay, only of how noise averages.
  void holdDelaysOfStillViews() {
    const auto speeds = medianSpeeds(table_, true);
    for (std::size_t c = 0; c < speeds.size(); ++c)
      if (problem_.HasParameterBlock(&late_blocks_[c]) && speeds[c] &&
          *speeds[c] * table_.period_s < kTellingSigmas * options_.sigma_px)
        problem_.SetParameterBlockConstant(&late_blocks_[c]);
  }

  /// A block without a sigma stays where it is.
  template <int kSize>
  void holdNear(double* block, const double* given, double sigma) {
    if (!problem_.HasParameterBlock(block)) return;
    ordering_->AddElementToGroup(block, 1);
    if (sigma > 0.0)
      problem_.AddResidualBlock(new PriorCost<kSize>(given, options_.free_body->sigma_px / sigma), nullptr,
                                block);
    else
      problem_.SetParameterBlockConstant(block);
  }

  void holdNearGiven() {
    const FreeBody& body = *options_.free_body;
    for (std::size_t i = 0; i < points_.size(); ++i)
      holdNear<3>(points_[i].data(), body.given[i].data(), body.sigmas.marker_sigma_m);
    for (double& scale : focal_scales_) holdNear<1>(&scale, &kGivenFocal, body.sigmas.focal_sigma);
  }

  void holdGauge() {
    if (options_.only_cameras) return;
    int fixed = 0;
    std::optional<std::size_t> held;
    for (std::size_t c = 0; c < camera_blocks_.size(); ++c) {
      if (!problem_.HasParameterBlock(camera_blocks_[c].data())) continue;
      fixed += state_.fixed[c] ? 1 : 0;
      if (!held || (state_.fixed[c] && !state_.fixed[*held])) held = c;
    }
    if (!held) return;
    problem_.SetParameterBlockConstant(camera_blocks_[*held].data());
    problem_.SetParameterBlockConstant(&late_blocks_[*held]);
    if (!body_ && fixed < 2) holdScale(*held);
  }

  void holdScale(std::size_t from) {
    const Eigen::Vector3d centre = state_.camera_from_world[from]->inverseTranslation();
    double* farthest = nullptr;
    double distance = 1e-9;
    for (std::size_t c = 0; c < camera_blocks_.size(); ++c) {
      if (!problem_.HasParameterBlock(camera_blocks_[c].data())) continue;
      const double apart = (state_.camera_from_world[c]->inverseTranslation() - centre).norm();
      if (apart <= distance) continue;
      distance = apart;
      farthest = camera_blocks_[c].data();
    }
    if (farthest != nullptr) problem_.AddResidualBlock(new ScaleCost(centre, distance), nullptr, farthest);
  }

  void takeOver() {
    if (options_.free_body != nullptr) {
      options_.free_body->points = points_;
      options_.free_body->focal_scales = focal_scales_;
    }
    if (options_.late_s != nullptr) *options_.late_s = late_blocks_;
    for (std::size_t c = 0; c < camera_blocks_.size(); ++c)
      if (problem_.HasParameterBlock(camera_blocks_[c].data()) && !state_.fixed[c])
        state_.camera_from_world[c] = toTransform(camera_blocks_[c].data());
    for (std::size_t i = 0; i < item_blocks_.size(); ++i) {
      const double* block = item_blocks_[i].data();
      if (!problem_.HasParameterBlock(block)) continue;
      if (body_)
        state_.world_from_body[i] = toTransform(block);
      else
        state_.points[i] = Eigen::Map<const Eigen::Vector3d>(block);
    }
  }

  static ceres::Problem::Options problemOptions() {
    ceres::Problem::Options options;
    options.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    options.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    return options;
  }

  RigState& state_;
  const SightingTable& table_;
  BundleOptions options_;
  bool body_;
  CameraManifold camera_manifold_;
  BodyManifold body_manifold_;
  std::unique_ptr<ceres::LossFunction> loss_;
  std::vector<PoseBlock> camera_blocks_, item_blocks_;
  std::vector<double> late_blocks_;
  std::vector<Eigen::Vector3d> points_;  ///< of a free body
  std::vector<double> focal_scales_;     ///< likewise
  ceres::Problem problem_{problemOptions()};
  std::shared_ptr<ceres::ParameterBlockOrdering> ordering_;
};

}  // namespace

double adjustBundle(RigState& state, std::span<const RigCamera> cameras, const SightingTable& table,
                    const BundleOptions& options) {
  return Bundle(state, cameras, table, options).solve();
}

}  // namespace helical
