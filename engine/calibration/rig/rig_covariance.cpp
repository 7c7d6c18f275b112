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

constexpr double kSmallestEigenvalue = 1e-12;  // over the largest: below it a direction is open

/// Normal equations of the cameras, and of a free body's points and focal lengths, with each item eliminated
/// (Schur complement).
class ReducedSystem {
 public:
  ReducedSystem(const RigState& state, std::span<const RigCamera> cameras, const SightingTable& table,
                const FreeBody* free_body)
      : state_(state),
        cameras_(cameras),
        table_(table),
        free_body_(free_body),
        stride_(table.late_s.empty() ? 6 : 7),
        place_(cameras.size(), -1),
        focal_column_(cameras.size(), -1) {
    for (std::size_t c = 0; c < cameras.size(); ++c)
      if (state.camera_from_world[c] && !state.fixed[c]) place_[c] = unknown_++;
    first_free_ = columns_ = stride_ * unknown_;
    if (free_body != nullptr && free_body->sigmas.focal_sigma > 0.0)
      for (std::size_t c = 0; c < cameras.size(); ++c)
        if (state.camera_from_world[c]) focal_column_[c] = columns_++;
    if (free_body != nullptr && free_body->sigmas.marker_sigma_m > 0.0) {
      first_point_ = columns_;
      columns_ += 3 * static_cast<int>(free_body->points.size());
    }
    information = Eigen::MatrixXd::Zero(columns_, columns_);
    // As in the bundle: the delay of a camera that saw nothing move is not open.
    if (stride_ > 6)
      for (int k = 6; k < first_free_; k += stride_)
        information(k, k) = 1.0 / (table.period_s * table.period_s);
    const auto starts = itemStarts(table);
    for (std::size_t i = 0; i < static_cast<std::size_t>(table.items); ++i) addItem(starts[i], starts[i + 1]);
  }

  Eigen::MatrixXd information;
  double squares = 0.0;
  long freedom = 0;

  /// First of a camera's unknowns: its pose's six, then how late it saw if that was found. -1: none.
  int place(std::size_t camera) const { return place_[camera] < 0 ? -1 : stride_ * place_[camera]; }
  int stride() const { return stride_; }
  int size() const { return columns_; }
  bool hasCameras() const { return unknown_ > 0; }
  /// Of those that have no prior.
  int sizeOfCameras() const { return first_free_; }
  int focalColumn(std::size_t camera) const { return focal_column_[camera]; }
  int pointColumn(std::size_t point) const {
    return first_point_ < 0 ? -1 : first_point_ + 3 * static_cast<int>(point);
  }

  void addPriors(double sigma_px) {
    for (int column = first_free_; column < columns_; ++column) {
      const bool point = first_point_ >= 0 && column >= first_point_;
      const double sigma = point ? free_body_->sigmas.marker_sigma_m : free_body_->sigmas.focal_sigma;
      information(column, column) += sigma_px * sigma_px / (sigma * sigma);
    }
  }

 private:
  /// Derivatives of a pixel by the unknowns from `column` on.
  struct Part {
    int column;
    Eigen::MatrixXd derivatives;
  };

  std::vector<Part> partsOf(std::size_t row, const SightingDerivatives& d,
                            const Eigen::Vector2d& from_centre) const {
    const Sighting& s = table_.sightings[row];
    const auto camera = static_cast<std::size_t>(s.camera);
    std::vector<Part> parts;
    if (place_[camera] >= 0) {
      parts.push_back({stride_ * place_[camera], Eigen::MatrixXd(2, stride_)});
      parts.back().derivatives.leftCols<6>() = d.camera;
      if (stride_ > 6) parts.back().derivatives.col(6) = s.motion.velocity;
    }
    if (focal_column_[camera] >= 0) parts.push_back({focal_column_[camera], from_centre});
    if (first_point_ >= 0) {
      const auto point = static_cast<std::size_t>(free_body_->point[row]);
      const Eigen::Matrix3d rotation =
          state_.world_from_body[static_cast<std::size_t>(s.item)]->rotation.toRotationMatrix();
      parts.push_back({pointColumn(point), d.point * rotation});
    }
    return parts;
  }

  void addItem(std::size_t first, std::size_t end) {
    const bool body = table_.kind == TargetKind::kBody;
    const Eigen::Index size = body ? 6 : 3;
    Eigen::MatrixXd own = Eigen::MatrixXd::Zero(size, size);
    Eigen::MatrixXd mixed = Eigen::MatrixXd::Zero(columns_, size);
    std::map<int, Eigen::Index> touched;  // first column and width of parts
    long rows = 0;
    for (std::size_t row = first; row < end; ++row) {
      const Sighting& s = table_.sightings[row];
      const auto camera = static_cast<std::size_t>(s.camera);
      const auto residual = s.inlier ? sightingResidual(state_, cameras_, table_, s) : std::nullopt;
      if (!residual) continue;
      squares += residual->squaredNorm();
      rows += 2;
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
      own += item.transpose() * item;
      // A scale of what is there already: by as little as it moves, that is the same.
      const std::vector<Part> parts = partsOf(row, d, pixel - Eigen::Vector2d(model.cx(), model.cy()));
      for (const Part& a : parts) {
        mixed.middleRows(a.column, a.derivatives.cols()) += a.derivatives.transpose() * item;
        touched[a.column] = a.derivatives.cols();
        for (const Part& b : parts)
          information.block(a.column, b.column, a.derivatives.cols(), b.derivatives.cols()) +=
              a.derivatives.transpose() * b.derivatives;
      }
    }
    if (rows == 0) return;
    freedom += rows - size;
    // Few points leave a body's pose open; then its own information is singular and they tell nothing.
    const Eigen::MatrixXd inverse = own.completeOrthogonalDecomposition().pseudoInverse();
    for (const auto& [a, a_size] : touched) {
      const Eigen::MatrixXd weighed = mixed.middleRows(a, a_size) * inverse;
      for (const auto& [b, b_size] : touched)
        information.block(a, b, a_size, b_size) -= weighed * mixed.middleRows(b, b_size).transpose();
    }
  }

  const RigState& state_;
  std::span<const RigCamera> cameras_;
  const SightingTable& table_;
  const FreeBody* free_body_;
  int stride_;
  std::vector<int> place_, focal_column_;
  int unknown_ = 0, first_free_ = 0, columns_ = 0, first_point_ = -1;
};

/// Rows of what the gauge holds: all of the first camera's unknowns, and the distance of two cameras.
Eigen::MatrixXd gauge(const ReducedSystem& system, const RigState& state,
                      const std::optional<KnownDistance>& distance) {
  const bool frame = [&] {
    for (std::size_t c = 0; c < state.fixed.size(); ++c)
      if (state.fixed[c]) return false;
    return true;
  }();
  const int held = frame && system.hasCameras() ? system.stride() : 0;
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

}  // namespace

RigCovariance rigCovariance(const RigState& state, std::span<const RigCamera> cameras,
                            const SightingTable& table, const std::optional<KnownDistance>& distance,
                            const FreeBody* free_body) {
  RigCovariance result;
  result.cameras.resize(cameras.size());
  ReducedSystem system(state, cameras, table, free_body);
  const Eigen::Index size = system.size();
  const Eigen::MatrixXd held = size > 0 ? gauge(system, state, distance) : Eigen::MatrixXd();
  const double freedom = static_cast<double>(system.freedom - system.sizeOfCameras() + held.rows());
  if (freedom <= 0.0) return result;
  result.sigma_px = std::sqrt(system.squares / freedom);
  if (size == 0) return result;
  system.addPriors(result.sigma_px);
  // The directions that the gauge leaves free.
  Eigen::MatrixXd free_directions = Eigen::MatrixXd::Identity(size, size);
  if (held.rows() > 0) {
    const Eigen::HouseholderQR<Eigen::MatrixXd> qr(held.transpose());
    const Eigen::MatrixXd q = qr.householderQ();
    free_directions = q.rightCols(size - held.rows());
  }
  if (free_directions.cols() == 0) return result;
  const Eigen::MatrixXd information = free_directions.transpose() * system.information * free_directions;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(information);
  if (!(eigen.eigenvalues()[0] > kSmallestEigenvalue * eigen.eigenvalues().tail<1>()[0])) return result;
  const Eigen::MatrixXd covariance =
      free_directions * eigen.eigenvectors() * eigen.eigenvalues().cwiseInverse().asDiagonal() *
      eigen.eigenvectors().transpose() * free_directions.transpose() * (result.sigma_px * result.sigma_px);
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

}  // namespace helical
