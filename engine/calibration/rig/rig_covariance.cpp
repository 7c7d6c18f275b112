#include "engine/calibration/rig/rig_covariance.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <map>

#include "engine/calibration/rig/sighting_derivatives.h"

namespace helical {
namespace {

constexpr double kDoubtedFocal = 0.05;         // a lens that was calibrated is not farther off
constexpr double kSmallestEigenvalue = 1e-12;  // over the largest: below it a direction is open

/// Normal equations of the cameras' poses, of how late they saw where that was found, of focal lengths and of
/// a free body's points, with each item eliminated (Schur complement).
class ReducedSystem {
 public:
  ReducedSystem(const RigState& state, std::span<const RigCamera> cameras, const SightingTable& table,
                const SelfCalibrationOptions& sigmas, const FreeBody* free_body)
      : state_(state), cameras_(cameras), table_(table), sigmas_(sigmas), free_body_(free_body) {
    layOut();
    information = Eigen::MatrixXd::Zero(columns_, columns_);
    gradient = Eigen::VectorXd::Zero(columns_);
    // As in the bundle: the delay of a camera that saw nothing move is not open.
    for (const int column : delay_column_)
      if (column >= 0) information(column, column) = 1.0 / (table.period_s * table.period_s);
    const auto starts = itemStarts(table);
    for (std::size_t i = 0; i < static_cast<std::size_t>(table.items); ++i) addItem(starts[i], starts[i + 1]);
  }

  Eigen::MatrixXd information;
  Eigen::VectorXd gradient;  ///< of half the squares, downhill
  double squares = 0.0;
  long freedom = 0;

  /// First of the six of a camera's pose; -1: none.
  int place(std::size_t camera) const { return pose_column_[camera]; }
  int size() const { return columns_; }
  /// Of poses, which come first: that of the first camera at 0.
  int sizeOfPoses() const { return poses_; }
  /// Of those that have no prior: poses and delays.
  int sizeOfCameras() const { return first_free_; }
  int focalColumn(std::size_t camera) const { return focal_column_[camera]; }
  int pointColumn(std::size_t point) const {
    return first_point_ < 0 ? -1 : first_point_ + 3 * static_cast<int>(point);
  }

  double priorSigma(int column) const {
    return first_point_ >= 0 && column >= first_point_ ? sigmas_.marker_sigma_m : sigmas_.focal_sigma;
  }

  Eigen::MatrixXd withPriors(double sigma_px) const {
    Eigen::MatrixXd all = information;
    for (int column = first_free_; column < columns_; ++column)
      all(column, column) += std::pow(sigma_px / priorSigma(column), 2);
    return all;
  }

  /// How many of the unknowns with a prior the images tell: those count as unknowns, the others not.
  double told(const Eigen::MatrixXd& covariance) const {
    double count = 0.0;
    for (int column = first_free_; column < columns_; ++column)
      count += std::max(0.0, 1.0 - covariance(column, column) / std::pow(priorSigma(column), 2));
    return count;
  }

 private:
  /// Derivatives of a pixel by the unknowns from `column` on.
  struct Part {
    int column;
    Eigen::MatrixXd derivatives;
  };

  void layOut() {
    pose_column_.assign(cameras_.size(), -1);
    focal_column_ = delay_column_ = pose_column_;
    const auto posed = [&](std::size_t c) { return state_.camera_from_world[c].has_value(); };
    for (std::size_t c = 0; c < cameras_.size(); ++c) {
      if (!posed(c) || state_.fixed[c]) continue;
      pose_column_[c] = columns_;
      columns_ += 6;
    }
    poses_ = columns_;
    if (!table_.late_s.empty()) {
      const std::size_t held = timeKeeper(state_);
      for (std::size_t c = 0; c < cameras_.size(); ++c)
        if (posed(c) && c != held) delay_column_[c] = columns_++;
    }
    first_free_ = columns_;
    if (sigmas_.focal_sigma > 0.0)
      for (std::size_t c = 0; c < cameras_.size(); ++c)
        if (posed(c)) focal_column_[c] = columns_++;
    if (free_body_ != nullptr && sigmas_.marker_sigma_m > 0.0) {
      first_point_ = columns_;
      columns_ += 3 * static_cast<int>(free_body_->points.size());
    }
  }

  std::vector<Part> partsOf(std::size_t row, const SightingDerivatives& d,
                            const Eigen::Vector2d& from_centre) const {
    const Sighting& s = table_.sightings[row];
    const auto camera = static_cast<std::size_t>(s.camera);
    std::vector<Part> parts;
    if (pose_column_[camera] >= 0) parts.push_back({pose_column_[camera], d.camera});
    if (delay_column_[camera] >= 0) parts.push_back({delay_column_[camera], s.motion.velocity});
    if (focal_column_[camera] >= 0) parts.push_back({focal_column_[camera], from_centre});
    if (first_point_ >= 0) {
      const auto point = static_cast<std::size_t>(free_body_->point[row]);
      const Eigen::Matrix3d rotation =
          state_.world_from_body[static_cast<std::size_t>(s.item)]->rotation.toRotationMatrix();
      parts.push_back({pointColumn(point), d.point * rotation});
    }
    return parts;
  }

  /// What one item's sightings say.
  struct Item {
    Eigen::MatrixXd own, mixed;
    Eigen::VectorXd gradient;
    std::map<int, Eigen::Index> touched;  ///< first column and width of parts
    long rows = 0;
  };

  void addItem(std::size_t first, std::size_t end) {
    const Eigen::Index size = table_.kind == TargetKind::kBody ? 6 : 3;
    Item item{Eigen::MatrixXd::Zero(size, size),
              Eigen::MatrixXd::Zero(columns_, size),
              Eigen::VectorXd::Zero(size),
              {},
              0};
    for (std::size_t row = first; row < end; ++row) addSighting(row, item);
    if (item.rows == 0) return;
    freedom += item.rows - size;
    // Few points leave a body's pose open; then its own information is singular and they tell nothing.
    const Eigen::MatrixXd inverse = item.own.completeOrthogonalDecomposition().pseudoInverse();
    for (const auto& [a, a_size] : item.touched) {
      const Eigen::MatrixXd weighed = item.mixed.middleRows(a, a_size) * inverse;
      gradient.segment(a, a_size) -= weighed * item.gradient;
      for (const auto& [b, b_size] : item.touched)
        information.block(a, b, a_size, b_size) -= weighed * item.mixed.middleRows(b, b_size).transpose();
    }
  }

  void addSighting(std::size_t row, Item& to) {
    const Sighting& s = table_.sightings[row];
    const auto camera = static_cast<std::size_t>(s.camera);
    const auto residual = s.inlier ? sightingResidual(state_, cameras_, table_, s) : std::nullopt;
    if (!residual) return;
    const bool body = table_.kind == TargetKind::kBody;
    squares += residual->squaredNorm();
    to.rows += 2;
    const RigidTransform& pose = *state_.camera_from_world[camera];
    const Eigen::Vector3d point = *pointInWorld(state_, table_, s);
    const Eigen::Vector3d arm =
        body ? (state_.world_from_body[static_cast<std::size_t>(s.item)]->rotation * s.in_body).eval()
             : Eigen::Vector3d::Zero().eval();
    Eigen::Matrix<double, 2, 3> d_pixel;
    const CameraModel& model = cameras_[camera].model;
    const Eigen::Vector2d pixel = model.project(pose * point, &d_pixel).value_or(s.pixel);
    const SightingDerivatives d = sightingDerivatives(pose, point, arm, d_pixel);
    const Eigen::MatrixXd item = body ? Eigen::MatrixXd(d.body) : Eigen::MatrixXd(d.point);
    to.own += item.transpose() * item;
    to.gradient += item.transpose() * *residual;
    // A scale of what is there already: by as little as it moves, that is the same.
    const std::vector<Part> parts = partsOf(row, d, pixel - Eigen::Vector2d(model.cx(), model.cy()));
    for (const Part& a : parts) {
      const Eigen::Index width = a.derivatives.cols();
      to.mixed.middleRows(a.column, width) += a.derivatives.transpose() * item;
      to.touched[a.column] = width;
      gradient.segment(a.column, width) += a.derivatives.transpose() * *residual;
      for (const Part& b : parts)
        information.block(a.column, b.column, width, b.derivatives.cols()) +=
            a.derivatives.transpose() * b.derivatives;
    }
  }

  const RigState& state_;
  std::span<const RigCamera> cameras_;
  const SightingTable& table_;
  SelfCalibrationOptions sigmas_;
  const FreeBody* free_body_;
  std::vector<int> pose_column_, delay_column_, focal_column_;
  int poses_ = 0, first_free_ = 0, columns_ = 0, first_point_ = -1;
};

/// Rows of what the gauge holds: the first camera's pose, and the distance of two cameras.
Eigen::MatrixXd gauge(const ReducedSystem& system, const RigState& state,
                      const std::optional<KnownDistance>& distance) {
  const bool frame = std::find(state.fixed.begin(), state.fixed.end(), true) == state.fixed.end();
  const int held = frame && system.sizeOfPoses() > 0 ? 6 : 0;
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(held + (distance ? 1 : 0), system.size());
  rows.topLeftCorner(held, held).setIdentity();
  if (distance) {
    const Eigen::Vector3d along = (state.camera_from_world[distance->a]->inverseTranslation() -
                                   state.camera_from_world[distance->b]->inverseTranslation())
                                      .normalized();
    const Eigen::Index last = rows.rows() - 1;
    if (const int k = system.place(distance->a); k >= 0) rows.block<1, 3>(last, k + 3) = along.transpose();
    if (const int k = system.place(distance->b); k >= 0) rows.block<1, 3>(last, k + 3) = -along.transpose();
  }
  return rows;
}

/// A system solved in the directions that its gauge leaves free.
class SolvedSystem {
 public:
  SolvedSystem(const ReducedSystem& system, const RigState& state,
               const std::optional<KnownDistance>& distance)
      : system_(system) {
    const Eigen::Index size = system.size();
    const Eigen::MatrixXd held = size > 0 ? gauge(system, state, distance) : Eigen::MatrixXd();
    freedom_ = static_cast<double>(system.freedom - system.sizeOfCameras() + held.rows());
    if (freedom_ <= 0.0) return;
    sigma_px = std::sqrt(system.squares / freedom_);
    free_directions_ = Eigen::MatrixXd::Identity(size, size);
    if (held.rows() > 0) {
      const Eigen::HouseholderQR<Eigen::MatrixXd> qr(held.transpose());
      const Eigen::MatrixXd q = qr.householderQ();
      free_directions_ = q.rightCols(size - held.rows());
    }
    if (free_directions_.cols() == 0) return;
    solve();
    if (!covariance || system.sizeOfCameras() == size) return;
    // What has a prior counts as an unknown as far as the images tell it.
    const double freedom = freedom_ - system.told(*covariance);
    covariance.reset();
    if (freedom <= 0.0) return;
    sigma_px = std::sqrt(system.squares / freedom);
    solve();
  }

  double sigma_px = 0.0;
  std::optional<Eigen::MatrixXd> covariance;  ///< nothing where the recording leaves something open

  /// One step of Gauss and Newton.
  Eigen::VectorXd step() const { return *covariance * system_.gradient / (sigma_px * sigma_px); }

 private:
  void solve() {
    const Eigen::MatrixXd information =
        free_directions_.transpose() * system_.withPriors(sigma_px) * free_directions_;
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(information);
    if (!(eigen.eigenvalues()[0] > kSmallestEigenvalue * eigen.eigenvalues().tail<1>()[0])) return;
    covariance = free_directions_ * eigen.eigenvectors() * eigen.eigenvalues().cwiseInverse().asDiagonal() *
                 eigen.eigenvectors().transpose() * free_directions_.transpose() * (sigma_px * sigma_px);
  }

  const ReducedSystem& system_;
  Eigen::MatrixXd free_directions_;
  double freedom_ = 0.0;
};

}  // namespace

RigCovariance rigCovariance(const RigState& state, std::span<const RigCamera> cameras,
                            const SightingTable& table, const std::optional<KnownDistance>& distance,
                            const FreeBody* free_body) {
  RigCovariance result;
  result.cameras.resize(cameras.size());
  const ReducedSystem system(state, cameras, table,
                             free_body == nullptr ? SelfCalibrationOptions{} : free_body->sigmas, free_body);
  const SolvedSystem solved(system, state, distance);
  result.sigma_px = solved.sigma_px;
  if (!solved.covariance) return result;
  const Eigen::MatrixXd& covariance = *solved.covariance;
  for (std::size_t c = 0; c < cameras.size(); ++c)
    if (const int k = system.place(c); k >= 0) {
      const Matrix6d block = covariance.block<6, 6>(k, k);
      result.cameras[c] = 0.5 * (block + block.transpose());
    }
  if (free_body == nullptr) return result;
  for (std::size_t c = 0; c < cameras.size(); ++c) {
    const int column = system.focalColumn(c);
    result.focal_sigmas.push_back(column < 0 ? 0.0 : std::sqrt(covariance(column, column)));
  }
  for (std::size_t i = 0; i < free_body->points.size(); ++i) {
    const int column = system.pointColumn(i);
    double variance = 0.0;
    if (column >= 0) {
      const Eigen::Matrix3d block = covariance.block<3, 3>(column, column);
      variance = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(block).eigenvalues()[2];
    }
    result.point_sigmas_m.push_back(std::sqrt(std::max(0.0, variance)));
  }
  return result;
}

std::vector<FocalDoubt> doubtFocals(const RigState& state, std::span<const RigCamera> cameras,
                                    const SightingTable& table,
                                    const std::optional<KnownDistance>& distance) {
  std::vector<FocalDoubt> doubts(cameras.size());
  SelfCalibrationOptions sigmas;
  sigmas.focal_sigma = kDoubtedFocal;
  const ReducedSystem system(state, cameras, table, sigmas, nullptr);
  const SolvedSystem solved(system, state, distance);
  if (!solved.covariance) return doubts;
  const Eigen::VectorXd step = solved.step();
  for (std::size_t c = 0; c < cameras.size(); ++c) {
    if (const int k = system.focalColumn(c); k >= 0) {
      doubts[c].off = step[k];
      doubts[c].sigma = std::sqrt((*solved.covariance)(k, k));
    }
    if (const int k = system.place(c); k >= 0) doubts[c].moves_by = step.segment<3>(k + 3).norm();
  }
  return doubts;
}

}  // namespace helical
