#pragma once

#include <string>
#include <vector>

#include "engine/session/session_summary.h"

namespace helical {

/// One figure of several flights.
struct ComparisonRow {
  std::string key;   ///< "hover_horizontal_mm"; for scripts
  std::string name;  ///< for people
  std::string unit;
  int decimals = 0;
  std::vector<double> values;      ///< one for each flight; NaN: not known. Empty for words.
  std::vector<std::string> words;  ///< one for each flight, in place of values
};

/// What several flights have in common to be told apart by: set-up, outcome, errors, latencies, and for every
/// camera that one of them names (by its label) what became of it. Pure.
std::vector<ComparisonRow> compareSessions(const std::vector<SessionSummary>& sessions);

/// What of each flight's time is shown as zero: when its rotors began to turn, or where one of the flights
/// never took off the beginning of each.
std::vector<double> commonZeros(const std::vector<SessionSummary>& sessions);

/// "A", "B", ...: a flight in legends, beside its file's name.
std::string sessionLetter(std::size_t index);

}  // namespace helical
