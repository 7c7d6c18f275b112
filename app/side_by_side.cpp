#include "app/side_by_side.h"

#include <algorithm>
#include <utility>

#include "engine/base/check.h"
#include "engine/base/clock.h"

namespace helical {

void SideBySide::add(std::string name, std::function<void()> run, std::function<void()> prepare,
                     int repeats) {
  contestants_.push_back({std::move(name), std::move(run), std::move(prepare), repeats, {}});
}

void SideBySide::measure(int rounds) {
  for (Contestant& contestant : contestants_) contestant.run();
  for (int round = 0; round < rounds; ++round)
    for (Contestant& contestant : contestants_) {
      if (contestant.prepare) contestant.prepare();
      const TimeNs start = threadCpuTime();
      for (int i = 0; i < contestant.repeats; ++i) contestant.run();
      const auto taken = static_cast<double>(threadCpuTime() - start);
      contestant.times_us.push_back(taken * 1e-3 / contestant.repeats);
    }
}

double SideBySide::medianUs(const std::string& name) const {
  const auto found = std::find_if(contestants_.begin(), contestants_.end(),
                                  [&name](const Contestant& contestant) { return contestant.name == name; });
  HELICAL_CHECK(found != contestants_.end() && !found->times_us.empty());
  std::vector<double> times = found->times_us;
  const auto middle = times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2);
  std::nth_element(times.begin(), middle, times.end());
  return *middle;
}

double SideBySide::ratio(const std::string& slow, const std::string& fast) const {
  return medianUs(slow) / medianUs(fast);
}

}  // namespace helical
