#pragma once

#include <functional>
#include <string>
#include <vector>

namespace helical {

/// Times several ways of doing the same thing in one process, in turn, so that a machine that speeds up or
/// slows down does so for all of them. What counts is the median of the thread's processor time, without what
/// reading that clock takes. One thread.
class SideBySide {
 public:
  /// `prepare` runs before every timed `run` and is not timed. A run too short for the clock is repeated
  /// `repeats` times in one reading; the figures are of one.
  void add(std::string name, std::function<void()> run, std::function<void()> prepare = {}, int repeats = 1);

  /// Runs everything once untimed, then `rounds` times timed.
  void measure(int rounds);

  double medianUs(const std::string& name) const;
  /// How many times longer `slow` takes than `fast`.
  double ratio(const std::string& slow, const std::string& fast) const;

 private:
  struct Contestant {
    std::string name;
    std::function<void()> run;
    std::function<void()> prepare;
    int repeats;
    std::vector<double> times_us;
  };

  std::vector<Contestant> contestants_;
};

}  // namespace helical
