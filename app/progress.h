#pragma once

#include <chrono>
#include <string>

namespace helical {

/// Progress on stderr: a bar on a terminal, a line every few seconds elsewhere, nothing for work that ends at
/// once.
class Progress {
 public:
  explicit Progress(std::string what);
  ~Progress();  ///< clears the bar

  /// `done` of 0..1; `note` is shown behind it.
  void update(double done, const std::string& note = {});

 private:
  std::string what_;
  bool terminal_;
  bool shown_ = false;
  std::chrono::steady_clock::time_point started_;
  std::chrono::steady_clock::time_point last_;
};

}  // namespace helical
