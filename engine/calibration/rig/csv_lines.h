#pragma once

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace helical {

/// The lines of a large text file, one after the other, without its being in memory as a whole. Throws
/// Error(kInput) when the file cannot be read or a line is longer than any table's. One thread.
class CsvLines {
 public:
  explicit CsvLines(const std::filesystem::path& file);

  /// The next line without its end; it lives until the next call. False at the end of the file.
  bool next(std::string_view& line);

  long number() const { return number_; }  ///< of the last line, counted from 1
  double progress() const;                 ///< share of the file that has been read

 private:
  struct Closer {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  bool refill();

  std::string path_;
  std::unique_ptr<std::FILE, Closer> file_;
  std::vector<char> buffer_;
  std::size_t begin_ = 0, end_ = 0;
  double read_ = 0.0, size_ = 0.0;
  long number_ = 0;
};

/// The fields of a line, without blanks and quotes around them.
void splitCsv(std::string_view line, std::vector<std::string_view>& fields);

}  // namespace helical
