#pragma once

#include <span>

namespace helical {

/// Systematic resampling (Kitagawa 1996): particle i gets floor(n w_i) or that plus one children.
/// `uniform` in [0, 1) is the one random number; `weights` sum to 1; `parents` has their length and comes out
/// ascending.
void systematicResample(std::span<const double> weights, double uniform, std::span<int> parents);

/// 1 / sum of squares of weights that sum to 1.
double effectiveSampleSize(std::span<const double> weights);

/// Weights that sum to 1 from logarithms, without overflow. In place of nothing finite: equal weights.
void normaliseLogWeights(std::span<const double> log_weights, std::span<double> weights);

}  // namespace helical
