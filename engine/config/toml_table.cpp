#include "engine/config/toml_table.h"

#include <toml++/toml.h>
#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "engine/base/error.h"

namespace helical {
namespace {

/// Levenshtein's distance.
int editDistance(std::string_view a, std::string_view b) {
  std::vector<int> row(b.size() + 1);
  std::iota(row.begin(), row.end(), 0);
  for (std::size_t i = 0; i < a.size(); ++i) {
    int diagonal = std::exchange(row[0], static_cast<int>(i) + 1);
    for (std::size_t j = 0; j < b.size(); ++j) {
      const int replaced = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, diagonal + 1});
    }
  }
  return row.back();
}

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const auto& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

std::string suggestion(std::string_view unknown, const std::vector<std::string>& known) {
  const auto distance = [&](const std::string& word) { return editDistance(unknown, word); };
  const auto nearest = std::min_element(
      known.begin(), known.end(), [&](const auto& a, const auto& b) { return distance(a) < distance(b); });
  if (nearest != known.end() && distance(*nearest) <= std::max<int>(2, static_cast<int>(unknown.size()) / 3))
    return "did you mean '" + *nearest + "'?";
  return "remove it; known here: " + joined(known);
}

const char* nameOf(toml::node_type type) {
  switch (type) {
    case toml::node_type::table:
      return "a table";
    case toml::node_type::array:
      return "an array";
    case toml::node_type::string:
      return "a text";
    case toml::node_type::integer:
      return "an integer";
    case toml::node_type::floating_point:
      return "a number";
    case toml::node_type::boolean:
      return "true or false";
    default:
      return "a date or time";
  }
}

/// "key" without the unit at its end: the name of the variable it sets.
std::string_view withoutUnit(std::string_view key) {
  for (const std::string_view unit : {"_deg", "_m_s", "_m"})
    if (key.ends_with(unit)) return key.substr(0, key.size() - unit.size());
  return key;
}

bool mentions(std::string_view text, std::string_view name) {
  const auto within = [&](std::size_t at) {
    return at < text.size() && (std::isalnum(static_cast<unsigned char>(text[at])) || text[at] == '_');
  };
  for (std::size_t at = text.find(name); at != std::string_view::npos; at = text.find(name, at + 1))
    if (!within(at - 1) && !within(at + name.size())) return true;
  return false;
}

}  // namespace

struct TomlTable::State {
  std::shared_ptr<const toml::table> document;
  const toml::table* table = nullptr;  // nothing when the file leaves it out
  std::string file;
  std::string path;  // of this table in the file, as users write it; empty for the root
  int line = 1;
  std::vector<std::string> known;
  std::vector<std::pair<std::string, std::string>> missing;  // key, example

  const toml::node* find(std::string_view key) {
    if (std::find(known.begin(), known.end(), key) == known.end()) known.emplace_back(key);
    return table != nullptr ? table->get(key) : nullptr;
  }

  std::unique_ptr<State> child(const toml::node* node, std::string_view key) const {
    auto state = std::make_unique<State>();
    state->document = document;
    state->table = node != nullptr ? node->as_table() : nullptr;
    state->file = file;
    state->path = path.empty() ? std::string(key) : path + "." + std::string(key);
    state->line = node != nullptr ? static_cast<int>(node->source().begin.line) : line;
    return state;
  }

  [[noreturn]] void fail(int at_line, const std::string& what, const std::string& cure) const {
    throw Error(ErrorKind::kInput, what, file + ":" + std::to_string(at_line), cure);
  }

  [[noreturn]] void wrongType(std::string_view key, const toml::node& node, const std::string& wanted) const {
    fail(static_cast<int>(node.source().begin.line),
         "'" + std::string(key) + "' is " + nameOf(node.type()) + ", not " + wanted,
         "write " + std::string(key) + " as " + wanted);
  }

  double finite(std::string_view key, const toml::node& node) const {
    const auto value = node.value<double>();
    if (!node.is_number() || !value) wrongType(key, node, "a number");
    if (!std::isfinite(*value))
      fail(static_cast<int>(node.source().begin.line), "'" + std::string(key) + "' is not finite",
           "give a number");
    return *value;
  }

  Eigen::VectorXd finiteArray(std::string_view key, const toml::node& node, int count) const {
    const std::string wanted = "an array of " + std::to_string(count) + " numbers";
    const toml::array* array = node.as_array();
    if (array == nullptr) wrongType(key, node, wanted);
    if (static_cast<int>(array->size()) != count)
      fail(static_cast<int>(node.source().begin.line),
           "'" + std::string(key) + "' has " + std::to_string(array->size()) + " entries, not " +
               std::to_string(count),
           "write " + std::string(key) + " as " + wanted);
    Eigen::VectorXd values(count);
    for (int i = 0; i < count; ++i) values[i] = finite(key, *array->get(static_cast<std::size_t>(i)));
    return values;
  }
};

TomlTable::TomlTable(std::unique_ptr<State> state) : state_(std::move(state)) {}
TomlTable::~TomlTable() = default;
TomlTable::TomlTable(TomlTable&&) noexcept = default;
TomlTable& TomlTable::operator=(TomlTable&&) noexcept = default;

TomlTable TomlTable::parse(std::string_view text, const std::string& name) {
  auto state = std::make_unique<State>();
  state->file = name;
  try {
    state->document = std::make_shared<const toml::table>(toml::parse(text));
  } catch (const toml::parse_error& error) {
    state->fail(static_cast<int>(error.source().begin.line), std::string(error.description()),
                "correct the TOML syntax of this line");
  }
  state->table = state->document.get();
  return TomlTable(std::move(state));
}

bool TomlTable::has(std::string_view key) const {
  return state_->table != nullptr && state_->table->contains(key);
}

std::optional<bool> TomlTable::boolean(std::string_view key) {
  const toml::node* node = state_->find(key);
  if (node == nullptr) return std::nullopt;
  if (!node->is_boolean()) state_->wrongType(key, *node, "true or false");
  return node->as_boolean()->get();
}

std::optional<int> TomlTable::integer(std::string_view key) {
  const toml::node* node = state_->find(key);
  if (node == nullptr) return std::nullopt;
  if (!node->is_integer()) state_->wrongType(key, *node, "an integer");
  const std::int64_t value = node->as_integer()->get();
  if (value < std::numeric_limits<int>::min() || value > std::numeric_limits<int>::max())
    fail(key, "'" + std::string(key) + "' is out of range", "give a smaller number");
  return static_cast<int>(value);
}

std::optional<double> TomlTable::number(std::string_view key) {
  const toml::node* node = state_->find(key);
  if (node == nullptr) return std::nullopt;
  return state_->finite(key, *node);
}

std::optional<std::string> TomlTable::text(std::string_view key) {
  const toml::node* node = state_->find(key);
  if (node == nullptr) return std::nullopt;
  if (!node->is_string()) state_->wrongType(key, *node, "a text in quotes");
  return node->as_string()->get();
}

std::optional<std::string> TomlTable::textOrInteger(std::string_view key) {
  const toml::node* node = state_->find(key);
  if (node == nullptr) return std::nullopt;
  if (node->is_integer()) return std::to_string(node->as_integer()->get());
  if (!node->is_string()) state_->wrongType(key, *node, "a text in quotes or an integer");
  return node->as_string()->get();
}

std::optional<Eigen::VectorXd> TomlTable::numbers(std::string_view key, int count) {
  const toml::node* node = state_->find(key);
  if (node == nullptr) return std::nullopt;
  return state_->finiteArray(key, *node, count);
}

std::optional<Eigen::VectorXd> TomlTable::numbers(std::string_view key, int count, int other_count) {
  const toml::node* node = state_->find(key);
  if (node == nullptr) return std::nullopt;
  const toml::array* array = node->as_array();
  const bool other = array != nullptr && static_cast<int>(array->size()) == other_count;
  return state_->finiteArray(key, *node, other ? other_count : count);
}

std::optional<std::vector<Eigen::Vector3d>> TomlTable::points(std::string_view key) {
  const toml::node* node = state_->find(key);
  if (node == nullptr) return std::nullopt;
  if (!node->is_array()) state_->wrongType(key, *node, "an array of [x, y, z]");
  std::vector<Eigen::Vector3d> points;
  for (const toml::node& point : *node->as_array()) points.emplace_back(state_->finiteArray(key, point, 3));
  return points;
}

std::optional<std::vector<std::vector<Eigen::Vector2d>>> TomlTable::polygons(std::string_view key) {
  const toml::node* node = state_->find(key);
  if (node == nullptr) return std::nullopt;
  const char* const wanted = "an array of polygons [[x, y], [x, y], [x, y]]";
  if (!node->is_array()) state_->wrongType(key, *node, wanted);
  std::vector<std::vector<Eigen::Vector2d>> polygons;
  for (const toml::node& polygon : *node->as_array()) {
    if (!polygon.is_array()) state_->wrongType(key, polygon, wanted);
    auto& corners = polygons.emplace_back();
    for (const toml::node& corner : *polygon.as_array())
      corners.emplace_back(state_->finiteArray(key, corner, 2));
    if (corners.size() < 3)
      state_->fail(static_cast<int>(polygon.source().begin.line),
                   "a polygon of '" + std::string(key) + "' has " + std::to_string(corners.size()) + " corners",
                   "give each polygon three corners [x, y] or more");
  }
  return polygons;
}

void TomlTable::missing(std::string_view key, std::string_view example) {
  state_->missing.emplace_back(key, example);
}

TomlTable TomlTable::table(std::string_view key) {
  const toml::node* node = state_->find(key);
  if (node != nullptr && !node->is_table()) state_->wrongType(key, *node, "a table");
  return TomlTable(state_->child(node, key));
}

std::vector<TomlTable> TomlTable::tables(std::string_view key) {
  std::vector<TomlTable> tables;
  const toml::node* node = state_->find(key);
  if (node == nullptr) return tables;
  const std::string wanted = "tables, each under [[" + state_->child(nullptr, key)->path + "]]";
  if (!node->is_array()) state_->wrongType(key, *node, wanted);
  for (const toml::node& entry : *node->as_array()) {
    if (!entry.is_table()) state_->wrongType(key, entry, wanted);
    tables.push_back(TomlTable(state_->child(&entry, key)));
  }
  return tables;
}

void TomlTable::finish() const {
  const std::string where = state_->path.empty() ? "" : " in [" + state_->path + "]";
  if (state_->table != nullptr)
    for (const auto& [key, node] : *state_->table)
      if (std::find(state_->known.begin(), state_->known.end(), key.str()) == state_->known.end())
        state_->fail(static_cast<int>(key.source().begin.line),
                     "unknown key '" + std::string(key.str()) + "'" + where,
                     suggestion(key.str(), state_->known));
  if (!state_->missing.empty()) {
    const auto& [key, example] = state_->missing.front();
    state_->fail(state_->line, "'" + key + "' is missing" + where, "add " + example);
  }
}

void TomlTable::fail(std::string_view key, const std::string& what, const std::string& cure) const {
  state_->fail(lineOf(key), what, cure);
}

void TomlTable::locate(const std::function<void()>& check) const {
  try {
    check();
  } catch (const Error& error) {
    std::string_view culprit;
    const auto rank = [&](std::string_view key) { return std::pair(has(key), key.size()); };
    for (const std::string& key : state_->known)
      if (mentions(error.what(), withoutUnit(key)) && rank(key) > rank(culprit)) culprit = key;
    fail(culprit, error.problem(), error.cure());
  }
}

int TomlTable::line() const {
  return state_->line;
}

int TomlTable::lineOf(std::string_view key) const {
  if (state_->table == nullptr) return state_->line;
  const auto entry = state_->table->find(key);
  return entry == state_->table->end() ? state_->line : static_cast<int>(entry->first.source().begin.line);
}

}  // namespace helical
