#include "engine/calibration/rig/csv_lines.h"

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "engine/base/error.h"

namespace helical {
namespace {

constexpr std::size_t kBufferSize = 1 << 20;

std::string_view trimmed(std::string_view text) {
  const auto blank = [](char c) { return c == ' ' || c == '\t' || c == '\r'; };
  while (!text.empty() && blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && blank(text.back())) text.remove_suffix(1);
  if (text.size() >= 2 && text.front() == '"' && text.back() == '"') text = text.substr(1, text.size() - 2);
  return text;
}

}  // namespace

CsvLines::CsvLines(const std::filesystem::path& file) : path_(file.string()), buffer_(kBufferSize) {
  std::error_code error;
  if (std::filesystem::is_directory(file, error))
    throw Error(ErrorKind::kInput, "this is a folder, not a CSV file", path_, "name the file inside it");
  file_.reset(std::fopen(file.c_str(), "rb"));
  if (!file_)
    throw Error(ErrorKind::kInput, std::string("cannot be read: ") + std::strerror(errno), path_,
                "check the path and that you may read it");
  const auto size = std::filesystem::file_size(file, error);
  size_ = error ? 0.0 : static_cast<double>(size);
}

bool CsvLines::refill() {
  std::copy(buffer_.begin() + static_cast<std::ptrdiff_t>(begin_),
            buffer_.begin() + static_cast<std::ptrdiff_t>(end_), buffer_.begin());
  end_ -= begin_;
  begin_ = 0;
  if (end_ == buffer_.size())
    throw Error(ErrorKind::kInput, "the line is longer than 1 MiB: this is no table of points",
                path_ + ":" + std::to_string(number_ + 1), "name a CSV file of time_s,camera,u_px,v_px");
  const std::size_t got = std::fread(buffer_.data() + end_, 1, buffer_.size() - end_, file_.get());
  if (std::ferror(file_.get()) != 0)
    throw Error(ErrorKind::kInput, "reading failed", path_, "check the disk");
  end_ += got;
  read_ += static_cast<double>(got);
  return got > 0;
}

bool CsvLines::next(std::string_view& line) {
  for (std::size_t searched = 0;;) {
    const char* start = buffer_.data() + begin_;
    const void* found = std::memchr(start + searched, '\n', end_ - begin_ - searched);
    if (found != nullptr) {
      const auto length = static_cast<std::size_t>(static_cast<const char*>(found) - start);
      line = {start, length};
      begin_ += length + 1;
      break;
    }
    searched = end_ - begin_;
    if (!refill()) {
      if (begin_ == end_) return false;
      line = {buffer_.data() + begin_, end_ - begin_};
      begin_ = end_;
      break;
    }
  }
  ++number_;
  if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
  return true;
}

double CsvLines::progress() const {
  return size_ > 0.0 ? std::min(1.0, read_ / size_) : 0.0;
}

void splitCsv(std::string_view line, std::vector<std::string_view>& fields) {
  fields.clear();
  while (true) {
    const void* comma = std::memchr(line.data(), ',', line.size());
    if (line.empty() || comma == nullptr) break;
    const auto length = static_cast<std::size_t>(static_cast<const char*>(comma) - line.data());
    fields.push_back(trimmed(line.substr(0, length)));
    line.remove_prefix(length + 1);
  }
  fields.push_back(trimmed(line));
}

}  // namespace helical
