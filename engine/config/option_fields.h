#pragma once

#include <limits>
#include <span>
#include <sstream>
#include <string>
#include <variant>

#include "engine/config/toml_table.h"

namespace helical {

/// How one key of a file sets one member of an options struct: `member = scale * value`, for low <= value <=
/// high. Bounds are for what the struct's own validate() does not know.
template <class Options>
struct OptionField {
  const char* key;
  std::variant<double Options::*, int Options::*> member;
  double scale = 1.0;
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
};

/// Sets the members whose keys `table` has and leaves the others as they are. Throws as TomlTable.
template <class Options, std::size_t N>
void readOptions(TomlTable& table, const OptionField<Options> (&fields)[N], Options& options) {
  for (const auto& field : fields) {
    const auto* whole = std::get_if<int Options::*>(&field.member);
    const auto integer = whole != nullptr ? table.integer(field.key) : std::nullopt;
    const auto value = table.number(field.key);
    if (!value) continue;
    if (*value < field.low || *value > field.high) {
      std::ostringstream range;
      range << "give a number from " << field.low << " to " << field.high;
      table.fail(field.key, "'" + std::string(field.key) + "' is out of range", range.str());
    }
    if (integer)
      options.** whole = *integer;
    else
      options.*std::get<double Options::*>(field.member) = field.scale * *value;
  }
}

}  // namespace helical
