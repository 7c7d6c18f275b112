#include "tests/geometry/random_geometry.h"

namespace helical {

Eigen::Vector3d randomVector(Random& random, double largest) {
  return {random.uniform(-largest, largest), random.uniform(-largest, largest),
          random.uniform(-largest, largest)};
}

Eigen::Quaterniond randomRotation(Random& random) {
  return Eigen::Quaterniond(random.normal(), random.normal(), random.normal(), random.normal()).normalized();
}

RigidTransform randomTransform(Random& random) {
  return {randomRotation(random), randomVector(random, 5.0)};
}

Eigen::MatrixXd numericJacobian(const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& f,
                                const Eigen::VectorXd& x, double step) {
  Eigen::MatrixXd jacobian(f(x).size(), x.size());
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    const Eigen::VectorXd d = step * Eigen::VectorXd::Unit(x.size(), i);
    jacobian.col(i) = (f(x + d) - f(x - d)) / (2.0 * step);
  }
  return jacobian;
}

}  // namespace helical
