#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "engine/markers/disc_kernels.h"
#include "engine/markers/disc_normal.h"

namespace helical {

/// Normal matrix of a model of `kSize` parameters that begin with a disc's, with what is known of its light.
template <int kSize>
Eigen::Matrix<double, kSize, kSize> normalWithPrior(const DiscSums& sums, double ambient) {
  Eigen::Matrix<double, kSize, kSize> normal = normalOf<kSize>(sums);
  normal.diagonal().array() += 1e-9;
  normal(kDiscLightZ, kDiscLightZ) += lightPrior(ambient);
  return normal;
}

/// Levenberg and Marquardt over all parameters of a model that begins with a disc's: to the least squares
/// near to where it stands. `Model` has `kSize`, `disc`, `squares` and `count` of the given cells,
/// `measure(cells)`, which fills the cells and gives their sums, and `moved(change)`. Repeats bit for bit. No
/// allocation.
template <class Model>
void descendTo(Model& model, DiscCells& cells, int steps) {
  constexpr double kSettled = 2e-3;  // cells: a smaller step is the last
  constexpr double kFirstDamping = 0.01, kMostDamping = 1e4;
  constexpr double kFarthest = 0.5;  // radii: of one step
  using Vector = Eigen::Matrix<double, Model::kSize, 1>;
  const auto cost = [](const Model& at, const DiscSums& sums) {
    const double light = at.disc[kDiscLightZ];
    return sums.squares + lightPrior(at.disc[kDiscAmbient]) * light * light;
  };
  DiscSums sums = model.measure(cells);
  model.squares = sums.squares;
  model.count = sums.count;
  double least = cost(model, sums), damping = kFirstDamping;
  for (int step = 0; step < steps && damping < kMostDamping;) {
    const double ambient = model.disc[kDiscAmbient];
    const auto normal = normalWithPrior<Model::kSize>(sums, ambient);
    Vector gradient = Eigen::Map<const Vector>(sums.gradient.data());
    gradient[kDiscLightZ] -= lightPrior(ambient) * model.disc[kDiscLightZ];
    for (bool is_better = false; !is_better && step < steps && damping < kMostDamping; ++step) {
      auto damped = normal;
      damped.diagonal() *= 1.0 + damping;
      Vector change = NormalSolver<Model::kSize>(damped).solve(gradient);
      const double length = std::sqrt(change.template head<3>().squaredNorm()),
                   most = kFarthest * model.disc[kDiscRadius];
      if (!(length < 1e6)) return;
      if (length > most) change *= most / length;
      Model next = model.moved(change);
      next.disc[kDiscRadius] = std::max(next.disc[kDiscRadius], kSmallestDisc);
      sums = next.measure(cells);
      const double now = cost(next, sums);
      is_better = now < least;
      damping *= is_better ? 0.1 : 10.0;
      if (!is_better) continue;
      least = now;
      model = next;
      model.squares = sums.squares;
      model.count = sums.count;
      if (length < kSettled) return;
    }
  }
}

/// Of the centre of the disc in a model whose cells were just measured, with residuals of at least that
/// variance.
template <class Model>
Eigen::Matrix2d centreCovariance(const Model& model, const DiscSums& sums, double least_variance) {
  const NormalSolver<Model::kSize> solver(normalWithPrior<Model::kSize>(sums, model.disc[kDiscAmbient]));
  const double variance = sums.squares / std::max(1.0, sums.count - double{Model::kSize});
  return std::max(least_variance, variance) * solver.firstTwo();
}

}  // namespace helical
