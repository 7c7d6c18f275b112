#pragma once

#include <vector>

namespace helical {

/// The value below which `fraction` (0..1) of the values lie, linear between neighbours; NaN of none. Values
/// that are not finite count as larger than all others.
double quantile(std::vector<double> values, double fraction);

/// A value with its 95 % confidence interval.
struct Interval {
  double value = 0.0, low = 0.0, high = 0.0;
};

/// A quantile with the interval that order statistics give it, whatever the values' distribution.
Interval quantileInterval(const std::vector<double>& values, double fraction);

/// A share with its 95 % confidence interval.
struct Proportion {
  double value = 0.0;
  double low = 0.0;
  double high = 1.0;
};

/// Wilson's score interval (1927), which stays within 0..1 and means something for 0 and all of a few runs.
Proportion proportion(int successes, int runs);

}  // namespace helical
