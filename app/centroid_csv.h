#pragma once

#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>

#include "engine/markers/observation.h"

namespace helical {

/// The table `helical detect` writes: one line for each marker of each frame. Throws Error when the file
/// cannot be opened or written, saying why.
class CentroidCsv {
 public:
  explicit CentroidCsv(const std::filesystem::path& file);

  void add(int frame, std::optional<double> time_s, const Observation& observation);
  /// Makes sure that everything has reached the file.
  void finish();

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  void check(bool written) const;

  std::filesystem::path path_;
  std::unique_ptr<std::FILE, Close> file_;
};

}  // namespace helical
