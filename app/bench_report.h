#pragma once

#include <nlohmann/json_fwd.hpp>

namespace helical {

/// Prints what a benchmark found on stdout: as one JSON object, or as lines of "name: value" for people.
void printBenchReport(const nlohmann::ordered_json& report, bool as_json);

}  // namespace helical
