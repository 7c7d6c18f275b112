#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace helical {

/// One table of a TOML file, read key by key. Every key that is asked for counts as known; `finish` rejects
/// the others, so that a misspelt key is an error and never silently a default. Everything wrong throws
/// Error(kInput) with file, line, what and cure. A table that the file leaves out reads as empty. One thread.
class TomlTable {
 public:
  /// The root table of a text; `name` stands for the file in messages.
  static TomlTable parse(std::string_view text, const std::string& name);
  ~TomlTable();
  TomlTable(TomlTable&&) noexcept;
  TomlTable& operator=(TomlTable&&) noexcept;

  bool has(std::string_view key) const;

  /// Values that may be left out. Numbers are finite; an integer is a number, a number is no integer.
  std::optional<bool> boolean(std::string_view key);
  std::optional<int> integer(std::string_view key);
  std::optional<double> number(std::string_view key);
  std::optional<std::string> text(std::string_view key);
  std::optional<std::string> textOrInteger(std::string_view key);
  /// Exactly `count` numbers.
  std::optional<Eigen::VectorXd> numbers(std::string_view key, int count);
  /// `count` or `other_count` numbers.
  std::optional<Eigen::VectorXd> numbers(std::string_view key, int count, int other_count);
  /// Any number of points [x, y, z].
  std::optional<std::vector<Eigen::Vector3d>> points(std::string_view key);
  /// Any number of polygons [[x, y], [x, y], [x, y], ...], each of three corners and more.
  std::optional<std::vector<std::vector<Eigen::Vector2d>>> polygons(std::string_view key);

  /// `value`, or what `missing` says is missing: `finish` reports it, after unknown keys, because a misspelt
  /// key is why most keys are missing.
  template <class T>
  T required(std::string_view key, std::optional<T> value, T fallback, std::string_view example) {
    if (!value) missing(key, example);
    return value ? *value : fallback;
  }

  TomlTable table(std::string_view key);
  std::vector<TomlTable> tables(std::string_view key);

  /// Throws for the first key that was never asked for, else for the first required one that is missing.
  void finish() const;

  /// Throws Error(kInput) at the line of `key`, or at the table's own when the file does not have that key.
  [[noreturn]] void fail(std::string_view key, const std::string& what, const std::string& cure) const;

  /// Runs `check`; an Error from it comes out with the line of the key that it names, with or without its
  /// unit, else with the table's own line.
  void locate(const std::function<void()>& check) const;

  int line() const;
  int lineOf(std::string_view key) const;

 private:
  struct State;
  explicit TomlTable(std::unique_ptr<State> state);
  void missing(std::string_view key, std::string_view example);

  std::unique_ptr<State> state_;
};

}  // namespace helical
