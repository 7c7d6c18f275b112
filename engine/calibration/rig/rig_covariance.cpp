#include "engine/calibration/rig/rig_covariance.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>
#include <cmath>

#include "engine/calibration/rig/sighting_derivatives.h"

namespace helical {
namespace {

constexpr double kSmallestEigenvalue = 1e-12;  // over the largest: below it a direction is open

/// Normal equations of the cameras with each item eliminated (Schur complement).
class ReducedSystem {
 public:
  ReducedSystem(const RigState& state, std::span<const RigCamera> cameras, const SightingTable& table)
      : state_(state),
        cameras_(cameras),
        table_(table),
        stride_(table.late_s.empty() ? 6 : 7),
        place_(cameras.size(), -1) {
    for (std::size_t c = 0; c < cameras.size(); ++c)
      if (state.camera_from_world[c] && !state.fixed[c]) place_[c] = unknown_++;
    information = Eigen::MatrixXd::Zero(stride_ * unknown_, stride_ * unknown_);
    // As in the bundle: the delay of a camera that saw nothing move is not open.
    if (stride_ > 6)
      for (int k = 6; k < information.rows(); k += stride_)
        information(k, k) = 1.0 / (table.period_s * table.period_s);
    const auto starts = itemStarts(table);
    for (std::size_t i = 0; i < static_cast<std::size_t>(table.items); ++i)
      addItem(std::span(table.sightings).subspan(starts[i], starts[i + 1] - starts[i]));
  }

  Eigen::MatrixXd information;
  double squares = 0.0;
  long freedom = 0;

  /// First of a camera's unknowns: its pose's six, then how late it saw if that was found. -1: none.
  int place(std::size_t camera) const { return place_[camera] < 0 ? -1 : stride_ * place_[camera]; }
  int stride() const { return stride_; }
  int size() const { return stride_ * unknown_; }

 private:
  void addItem(std::span<const Sighting> sightings) {
    const bool body = table_.kind == TargetKind::kBody;
    const Eigen::Index size = body ? 6 : 3;
    Eigen::MatrixXd own = Eigen::MatrixXd::Zero(size, size);
    Eigen::MatrixXd mixed = Eigen::MatrixXd::Zero(stride_ * unknown_, size);
    std::vector<int> touched;
    long rows = 0;
    for (const Sighting& s : sightings) {
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
      cameras_[camera].model.project(pose * point, &d_pixel);
      const SightingDerivatives d = sightingDerivatives(pose, point, arm, d_pixel);
      const Eigen::MatrixXd item = body ? Eigen::MatrixXd(d.body) : Eigen::MatrixXd(d.point);
      own += item.transpose() * item;
      const int k = place_[camera];
      if (k < 0) continue;
      Eigen::Matrix<double, 2, Eigen::Dynamic, Eigen::ColMajor, 2, 7> own_camera(2, stride_);
      own_camera.leftCols<6>() = d.camera;
      if (stride_ > 6) own_camera.col(6) = s.motion.velocity;
      information.block(stride_ * k, stride_ * k, stride_, stride_) += own_camera.transpose() * own_camera;
      mixed.middleRows(stride_ * k, stride_) += own_camera.transpose() * item;
      if (touched.empty() || touched.back() != k) touched.push_back(k);
    }
    if (rows == 0) return;
    freedom += rows - size;
    // Few points leave a body's pose open; then its own information is singular and they tell nothing.
    const Eigen::MatrixXd inverse = own.completeOrthogonalDecomposition().pseudoInverse();
    for (const int a : touched)
      for (const int b : touched)
        information.block(stride_ * a, stride_ * b, stride_, stride_) -=
            mixed.middleRows(stride_ * a, stride_) * inverse *
            mixed.middleRows(stride_ * b, stride_).transpose();
  }

  const RigState& state_;
  std::span<const RigCamera> cameras_;
  const SightingTable& table_;
  int stride_;
  std::vector<int> place_;
  int unknown_ = 0;
};

/// Rows of what the gauge holds: all of the first camera's unknowns, and the distance of two cameras.
Eigen::MatrixXd gauge(const ReducedSystem& system, const RigState& state,
                      const std::optional<KnownDistance>& distance) {
  const bool frame = [&] {
    for (std::size_t c = 0; c < state.fixed.size(); ++c)
      if (state.fixed[c]) return false;
    return true;
  }();
  const int held = frame ? system.stride() : 0;
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
                            const SightingTable& table, const std::optional<KnownDistance>& distance) {
  RigCovariance result;
  result.cameras.resize(cameras.size());
  const ReducedSystem system(state, cameras, table);
  const Eigen::Index size = system.size();
  const Eigen::MatrixXd held = size > 0 ? gauge(system, state, distance) : Eigen::MatrixXd();
  const double freedom = static_cast<double>(system.freedom - size + held.rows());
  if (freedom <= 0.0) return result;
  result.sigma_px = std::sqrt(system.squares / freedom);
  if (size == 0) return result;
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
  return result;
}

}  // namespace helical
