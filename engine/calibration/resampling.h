#pragma once

#include <span>

namespace helical {

/// Systematic resampling (Kitagawa 1996): particle i gets floor(n w_i) or that plus one children.
/// `uniform` in [0, 1) is the one random number; `weights` sum to 1; `parents` has their length and comes out
/// ascending.
void systematicResample(std::span<const float> weights, double uniform, std::span<int> parents);

/// 1 / sum of squares of weights that sum to 1.
double effectiveSampleSize(std::span<const float> weights);

/// Weights that sum to 1 from logarithms, without overflow. In place of nothing finite: equal weights.
/// Returns the largest logarithm, or 0.
float normaliseLogWeights(std::span<const float> log_weights, std::span<float> weights);

}  // namespace helical
