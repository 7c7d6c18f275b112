#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace helical {

/// A value of the part of YAML that camera files use: block mappings and sequences by indentation, flow ones
/// in brackets over several lines, plain and quoted scalars; tags, comments and directives are passed over.
/// No anchors, no block scalars, no multiple documents.
struct YamlNode {
  enum class Kind { kNull, kScalar, kSequence, kMapping };
  Kind kind = Kind::kNull;
  int line = 0;
  std::string scalar;
  std::vector<YamlNode> items;                           ///< of a sequence
  std::vector<std::pair<std::string, YamlNode>> fields;  ///< of a mapping, in the file's order

  const YamlNode* find(std::string_view key) const;  ///< null if it is not there
  std::optional<double> number() const;              ///< finite
  /// All numbers in it, row by row, nested sequences flattened; nothing if anything else is in it.
  std::optional<std::vector<double>> numbers() const;
};

/// Throws Error(kInput) with `name` and line for what it cannot read.
YamlNode parseYaml(std::string_view text, const std::string& name);

}  // namespace helical
