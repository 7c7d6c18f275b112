#include "engine/calibration/rig/point_rows.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <unordered_map>

#include "engine/base/error.h"
#include "engine/calibration/rig/csv_lines.h"
#include "engine/calibration/rig/swapped_columns.h"

namespace helical {
namespace {

enum Column { kTime, kCamera, kU, kV, kMarker, kBodyX, kBodyY, kBodyZ, kColumns };
constexpr std::array<const char*, kColumns> kNames = {"time_s", "camera",   "u_px",     "v_px",
                                                      "marker", "body_x_m", "body_y_m", "body_z_m"};
const std::string kFormat = "time_s,camera,u_px,v_px[,marker][,body_x_m,body_y_m,body_z_m]";
constexpr long kLinesPerProgress = 65536;

struct TextHash {
  using is_transparent = void;
  std::size_t operator()(std::string_view text) const { return std::hash<std::string_view>()(text); }
};

/// As much of a field as a message can show.
std::string shown(std::string_view field) {
  std::string text(field.substr(0, 40));
  std::replace_if(
      text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < ' '; }, '?');
  return text;
}

class RowReader {
 public:
  RowReader(const std::filesystem::path& file, std::span<const RigCamera> cameras)
      : path_(file.string()), cameras_(cameras), lines_(file), swapped_(cameras) {}

  PointRows read(const ProgressCallback& progress) {
    readHeader();
    std::string_view line;
    while (lines_.next(line)) {
      if (line.find_first_not_of(" \t") == std::string_view::npos) continue;
      readRow(line);
      if (progress && lines_.number() % kLinesPerProgress == 0) progress(lines_.progress());
    }
    if (rows_.rows.empty())
      throw Error(ErrorKind::kInput, "the file has a header and no rows", path_, "record some observations");
    swapped_.check(path_);
    return std::move(rows_);
  }

 private:
  [[noreturn]] void fail(const std::string& what, const std::string& cure) const {
    throw Error(ErrorKind::kInput, what, path_ + ":" + std::to_string(std::max(1L, lines_.number())), cure);
  }

  void readHeader() {
    std::string_view line;
    if (!lines_.next(line))
      throw Error(ErrorKind::kInput, "the file is empty", path_,
                  "give a CSV file with the columns " + kFormat);
    if (line.starts_with("\xEF\xBB\xBF")) line.remove_prefix(3);
    splitCsv(line, fields_);
    column_.fill(-1);
    for (std::size_t i = 0; i < fields_.size(); ++i) {
      const auto name = std::find(kNames.begin(), kNames.end(), fields_[i]);
      if (name == kNames.end()) refuseColumn(fields_[i], line);
      int& place = column_[static_cast<std::size_t>(name - kNames.begin())];
      if (place >= 0) fail("the column '" + std::string(fields_[i]) + "' is there twice", "keep one of them");
      place = static_cast<int>(i);
    }
    for (const Column c : {kTime, kCamera, kU, kV})
      if (column_[c] < 0)
        fail("the column '" + std::string(kNames[c]) + "' is missing", "begin the file with " + kFormat);
    const int body = (column_[kBodyX] >= 0) + (column_[kBodyY] >= 0) + (column_[kBodyZ] >= 0);
    if (body != 0 && body != 3)
      fail("body_x_m, body_y_m and body_z_m are not all there", "give all three, or none of them");
    width_ = fields_.size();
    if (column_[kMarker] < 0) rows_.markers.emplace_back();
  }

  [[noreturn]] void refuseColumn(std::string_view name, std::string_view line) const {
    double ignored = 0.0;
    if (parse(name, ignored)) fail("the first line is no header", "begin the file with " + kFormat);
    if (line.find(';') != std::string_view::npos && line.find(',') == std::string_view::npos)
      fail("the columns are separated by semicolons", "separate them by commas, with decimal points");
    fail("unknown column '" + shown(name) + "'", "use the columns " + kFormat);
  }

  static bool parse(std::string_view text, double& value) {
    if (text.starts_with('+')) text.remove_prefix(1);
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc() && end == text.data() + text.size();
  }

  double number(Column column) const {
    const std::string_view text = fields_[static_cast<std::size_t>(column_[column])];
    double value = 0.0;
    if (!parse(text, value))
      fail("'" + shown(text) + "' in column " + kNames[column] + " is no number",
           "give a number, with a decimal point");
    if (!std::isfinite(value))
      fail(std::string("the value in column ") + kNames[column] + " is not finite",
           "leave out rows without a measurement");
    return value;
  }

  std::int32_t camera() const {
    const std::string_view label = fields_[static_cast<std::size_t>(column_[kCamera])];
    for (std::size_t i = 0; i < cameras_.size(); ++i)
      if (cameras_[i].label == label) return static_cast<std::int32_t>(i);
    std::string known;
    for (const RigCamera& c : cameras_) known += (known.empty() ? "" : ", ") + c.label;
    fail("the rig has no camera '" + shown(label) + "'",
         "use the rig's ids (" + known + "), and see that the columns stand in the order of the header");
  }

  std::int32_t marker() {
    if (column_[kMarker] < 0) return 0;
    const std::string_view name = fields_[static_cast<std::size_t>(column_[kMarker])];
    if (name.empty()) fail("the marker has no name", "name every marker, or leave the column out");
    if (const auto known = markers_.find(name); known != markers_.end()) return known->second;
    const auto id = static_cast<std::int32_t>(rows_.markers.size());
    markers_.emplace(std::string(name), id);
    rows_.markers.emplace_back(name);
    return id;
  }

  void readRow(std::string_view line) {
    splitCsv(line, fields_);
    if (fields_.size() != width_)
      fail("the row has " + std::to_string(fields_.size()) + " fields, the header " + std::to_string(width_),
           "see that no row is cut off and decimals have points");
    PointRow row;
    row.camera = camera();
    row.time_s = number(kTime);
    row.pixel = {number(kU), number(kV)};
    row.marker = marker();
    if (column_[kBodyX] >= 0) rows_.in_body.emplace_back(number(kBodyX), number(kBodyY), number(kBodyZ));
    swapped_.add(row);
    rows_.rows.push_back(row);
  }

  std::string path_;
  std::span<const RigCamera> cameras_;
  CsvLines lines_;
  SwappedColumns swapped_;
  std::vector<std::string_view> fields_;
  std::array<int, kColumns> column_{};
  std::size_t width_ = 0;
  std::unordered_map<std::string, std::int32_t, TextHash, std::equal_to<>> markers_;
  PointRows rows_;
};

}  // namespace

PointRows readPointRows(const std::filesystem::path& file, std::span<const RigCamera> cameras,
                        const ProgressCallback& progress) {
  return RowReader(file, cameras).read(progress);
}

}  // namespace helical
