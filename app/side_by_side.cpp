#include "app/side_by_side.h"

#include <algorithm>
#include <utility>

#include "engine/base/check.h"
#include "engine/base/clock.h"

namespace helical {
namespace {

/// Runs that take no longer than the clock's reading take at least its resolution: ratios stay finite.
constexpr double kLeastUs = 1e-3;

double medianOf(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// What two readings of the clock take by themselves: of a run of ten microseconds, a tenth.
double clockUs() {
  constexpr int kReadings = 201;
  std::vector<double> times_us;
  for (int i = 0; i < kReadings; ++i) {
    const TimeNs start = threadCpuTime();
    times_us.push_back(static_cast<double>(threadCpuTime() - start) * 1e-3);
  }
  return medianOf(times_us);
}

}  // namespace

void SideBySide::add(std::string name, std::function<void()> run, std::function<void()> prepare,
                     int repeats) {
  contestants_.push_back({std::move(name), std::move(run), std::move(prepare), repeats, {}});
}

void SideBySide::measure(int rounds) {
  const double clock_us = clockUs();
  for (Contestant& contestant : contestants_) contestant.run();
  for (int round = 0; round < rounds; ++round)
    for (Contestant& contestant : contestants_) {
      if (contestant.prepare) contestant.prepare();
      const TimeNs start = threadCpuTime();
      for (int i = 0; i < contestant.repeats; ++i) contestant.run();
      const auto taken_us = static_cast<double>(threadCpuTime() - start) * 1e-3;
      contestant.times_us.push_back(std::max(kLeastUs, taken_us - clock_us) / contestant.repeats);
    }
}

double SideBySide::medianUs(const std::string& name) const {
  const auto found = std::find_if(contestants_.begin(), contestants_.end(),
                                  [&name](const Contestant& contestant) { return contestant.name == name; });
  HELICAL_CHECK(found != contestants_.end() && !found->times_us.empty());
  return medianOf(found->times_us);
}

double SideBySide::ratio(const std::string& slow, const std::string& fast) const {
  return medianUs(slow) / medianUs(fast);
}

}  // namespace helical
