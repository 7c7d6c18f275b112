#pragma once

#include <Eigen/Core>
#include <functional>

#include "engine/base/random.h"
#include "engine/geometry/rigid_transform.h"

namespace helical {

Eigen::Vector3d randomVector(Random& random, double largest);
Eigen::Quaterniond randomRotation(Random& random);
RigidTransform randomTransform(Random& random);

/// Central differences of f at x.
Eigen::MatrixXd numericJacobian(const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& f,
                                const Eigen::VectorXd& x, double step = 1e-6);

}  // namespace helical
