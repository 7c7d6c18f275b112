#pragma once

#include <nlohmann/json_fwd.hpp>

namespace helical {

/// How far the default estimator's centres of drawn balls lie from the truth, over the Cramer-Rao bound of the
/// same pixels with every nuisance free (radius, colours of ball, wall and what hides it, its edge, light), and
/// the time for each: one entry for each radius, noise, shading and share that is hidden.
nlohmann::ordered_json benchCentroids();

}  // namespace helical
