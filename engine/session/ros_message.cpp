#include "engine/session/ros_message.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdio>
#include <iterator>
#include <sstream>

#include "engine/base/error.h"
#include "engine/session/message_units.h"

namespace helical {
namespace {

constexpr const char* kTime = "builtin_interfaces/Time";
constexpr std::uint32_t kLongestList = 1u << 20;
constexpr std::size_t kMostColumns = 1u << 14;

constexpr std::string_view kNumbers[] = {"bool",   "byte",  "char",   "float32", "float64",
                                         "int8",   "uint8", "int16",  "uint16",  "int32",
                                         "uint32", "int64", "uint64", "string"};

bool isPlain(const std::string& type) {
  return type == kTime || std::find(std::begin(kNumbers), std::end(kNumbers), type) != std::end(kNumbers);
}

template <class T>
std::string text(T value) {
  std::array<char, 32> buffer;
  // The shortest form that reads back as the same number.
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr;
  return std::string(buffer.data(), end);
}

std::string timeText(CdrReader& in) {
  const auto seconds = in.get<std::int32_t>();
  const auto nanoseconds = in.get<std::uint32_t>();
  std::array<char, 32> buffer;
  std::snprintf(buffer.data(), buffer.size(), "%d.%09u", seconds, nanoseconds);
  return buffer.data();
}

std::string plainText(CdrReader& in, const std::string& type) {
  if (type == kTime) return timeText(in);
  if (type == "float64") return text(in.get<double>());
  if (type == "float32") return text(in.get<float>());
  if (type == "bool") return in.getBool() ? "1" : "0";
  if (type == "byte" || type == "char" || type == "uint8") return text(int{in.get<std::uint8_t>()});
  if (type == "int8") return text(int{in.get<std::int8_t>()});
  if (type == "int16") return text(in.get<std::int16_t>());
  if (type == "uint16") return text(in.get<std::uint16_t>());
  if (type == "int32") return text(in.get<std::int32_t>());
  if (type == "uint32") return text(in.get<std::uint32_t>());
  if (type == "int64") return text(in.get<std::int64_t>());
  if (type == "uint64") return text(in.get<std::uint64_t>());
  return std::string(in.getText());
}

}  // namespace

RosMessage::RosMessage(const std::string& name, const std::string& definition) : name_(name) {
  parse(definition);
  addColumns("", "", false);
}

void RosMessage::parse(const std::string& definition) {
  std::istringstream lines(definition);
  std::string type;
  types_[type];
  for (std::string line; std::getline(lines, line);) {
    line = line.substr(0, line.find('#'));
    std::istringstream words(line);
    Field field;
    if (!(words >> field.type) || field.type.find_first_not_of('=') == std::string::npos) continue;
    words >> field.name;
    if (field.type == "MSG:") {
      type = field.name;
      types_[type];
      continue;
    }
    if (line.find('=') != std::string::npos) continue;  // a constant
    const std::size_t bracket = field.type.find('[');
    if (bracket != std::string::npos) {
      const std::string count = field.type.substr(bracket + 1);
      field.count = kAny;
      std::from_chars(count.data(), count.data() + count.size(), field.count);
      if (field.count < 0 || field.count > 4096) refuse("an array of a length that makes no sense");
      field.type.resize(bracket);
    }
    if (field.type == "builtin_interfaces/msg/Time") field.type = kTime;
    types_[type].push_back(field);
  }
}

void RosMessage::addColumns(const std::string& type, const std::string& prefix, bool in_list) {
  const auto found = types_.find(type);
  if (found == types_.end()) refuse("the type " + type + " is not defined");
  if (std::count(prefix.begin(), prefix.end(), '.') > 16) refuse("types inside each other without end");
  for (const Field& field : found->second) {
    if (columns_.size() > kMostColumns) refuse("more columns than a table can have");
    const std::string name = prefix + field.name;
    if (isPlain(field.type)) {
      if (field.count <= 0) columns_.push_back({name, unitOf(name_, name, 0)});
      for (int i = 0; i < field.count; ++i)
        columns_.push_back({name + "[" + std::to_string(i) + "]", unitOf(name_, name, i)});
      continue;
    }
    if (field.count > 0) refuse("an array of structures of fixed length");
    if (field.count == kAny && in_list) refuse("a list in a list");
    addColumns(field.type, name + ".", in_list || field.count == kAny);
  }
}

void RosMessage::rows(std::string_view payload,
                      const std::function<void(const std::vector<std::string>&)>& show) const {
  CdrReader in(payload);
  Cells cells;
  std::vector<Cells> list;
  std::size_t list_at = columns_.size();
  read(in, "", cells, list, list_at);
  if (list.empty()) {
    cells.insert(cells.begin() + static_cast<std::ptrdiff_t>(std::min(list_at, cells.size())),
                 columns_.size() - cells.size(), "");
    show(cells);
    return;
  }
  for (const Cells& element : list) {
    Cells row = cells;
    row.insert(row.begin() + static_cast<std::ptrdiff_t>(list_at), element.begin(), element.end());
    show(row);
  }
}

void RosMessage::read(CdrReader& in, const std::string& type, Cells& cells, std::vector<Cells>& list,
                      std::size_t& list_at) const {
  for (const Field& field : types_.at(type)) {
    const bool plain = isPlain(field.type);
    if (field.count == kAny && !plain) {
      readList(in, field.type, cells, list, list_at);
    } else if (field.count == kAny) {
      std::string cell;
      for (auto left = in.get<std::uint32_t>(); left > 0; --left)
        cell += (cell.empty() ? "" : " ") + plainText(in, field.type);
      cells.push_back(cell);
    } else if (plain) {
      for (int i = 0; i < std::max(1, field.count); ++i) cells.push_back(plainText(in, field.type));
    } else {
      read(in, field.type, cells, list, list_at);
    }
  }
}

void RosMessage::readList(CdrReader& in, const std::string& type, Cells& cells, std::vector<Cells>& list,
                          std::size_t& list_at) const {
  list_at = cells.size();
  const auto count = in.get<std::uint32_t>();
  if (count > kLongestList || count > in.left()) throw CutShort();
  std::vector<Cells> none;
  std::size_t nowhere = 0;
  for (std::uint32_t i = 0; i < count; ++i) {
    Cells element;
    read(in, type, element, none, nowhere);
    list.push_back(std::move(element));
  }
}

void RosMessage::refuse(const std::string& what) const {
  throw Error(ErrorKind::kInput, "messages of the type " + name_ + " cannot be read: " + what, {},
              "export them with the tool that wrote them");
}

}  // namespace helical
